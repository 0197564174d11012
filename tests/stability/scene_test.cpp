// SPDX-License-Identifier: BSD-3-Clause
// Extreme scenes, on coarse grids, by the product and by the naive scheme: cohesion by p_min, tall columns, very loose and very dense sand, steps up to and
// beyond the limit, the toe of the deposit.
#include "tests/stability/naive_scheme.hpp"
#include "tests/verification/scenes.hpp"

namespace {

using tests::ColumnCase, tests::value_of;

drivers::Summary run(const ColumnCase& c, const std::string& name, double step_factor = 0) {
  auto scene = tests::column_scene(c, "stability_" + name);
  if (step_factor > 0) scene.numerics.step_factor = step_factor;
  testing::internal::CaptureStdout();
  const auto summary = [&] {
    try {
      return drivers::run_scene(scene, {.quiet = true});
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
  }();
  testing::internal::GetCapturedStdout();
  std::printf("%-16s h_f/r0 %.3f, runout %.3f, rest after %.2f s, energy off by %.1g\n", name.c_str(),
              value_of(summary, "final_height"), value_of(summary, "runout"),
              value_of(summary, "time_to_rest"), value_of(summary, "energy_imbalance"));
  return summary;
}

/// Mean of ten runs that differ in the step alone.
struct Mean {
  double height = 0, front = 0;
};
Mean mean_of(const ColumnCase& c, const std::string& name) {
  Mean mean;
  constexpr int runs = 10;
  for (int k = 0; k < runs; ++k) {
    const auto summary = run(c, name, 0.4 - 0.005 * k);
    mean.height += value_of(summary, "final_height") / runs;
    mean.front += (1 + value_of(summary, "runout")) / runs;
  }
  return mean;
}

TEST(Scenes, TheFloorOfPressureDoesNotGlue) {
  const auto with = [](const std::string& p_min) {
    return mean_of({.spacing = 0.005, .extra = "p_min = " + p_min}, "p_min " + p_min);
  };
  const auto one = with("1"), ten = with("10"), hundred = with("100"), kilo = with("1000");
  // Not nothing, which is why the default is 1 Pa: means of ten runs are 0.97 and 0.92 in height.
  EXPECT_NEAR(ten.height / one.height, 1, 0.05);
  EXPECT_NEAR(ten.front / one.front, 1, 0.05);
  EXPECT_GT(std::abs(hundred.height / one.height - 1), 0.05);
  EXPECT_GT(std::abs(kilo.height / one.height - 1), 0.05);
}

/// A column in plane strain, followed without the guards of a run.
struct PlaneColumn {
  double gained = 0;  ///< largest mechanical energy, over that at the start, less one: sand can only lose it
  double highest = 0; ///< of any particle's path, over the height of the column
  double speed = 0;   ///< largest at the end, m/s
  double top = 0, front = 0; ///< at the end, over the height and the width of the column
  bool finite = true;
};
template <class Step>
PlaneColumn plane_column(ColumnCase c, const std::string& name, double end, const Step& step) {
  c.geometry = "plane_strain";
  auto s = host::start_simulation<host::PlaneStrain>(tests::column_scene(c, "stability_" + name));
  PlaneColumn out;
  double first = 0;
  while (s.time < end && out.finite) {
    step(s);
    const auto& p = s.particles;
    double energy = 0;
    out.speed = out.top = out.front = 0;
    for (int i = 0; i < p.count; ++i) {
      const double v = std::hypot(p.velocity[0][i], p.velocity[1][i]);
      energy += p.mass[i] * (0.5 * v * v + 9.81 * p.position[1][i]);
      out.speed = std::max(out.speed, v);
      out.top = std::max(out.top, p.position[1][i] / (0.05 * c.aspect));
      out.front = std::max(out.front, p.position[0][i] / 0.05);
      out.highest = std::max(out.highest, p.position[1][i] / (0.05 * c.aspect));
    }
    if (first == 0) first = energy;
    out.gained = std::max(out.gained, energy / first - 1);
    out.finite = std::isfinite(energy);
  }
  std::printf("%-24s mechanical energy %+.3f, highest %.2f h0, at the end %.2f h0 and %.2f r0, %.2f m/s at "
              "%.2f s%s\n",
              name.c_str(), out.gained, out.highest, out.top, out.front, out.speed, s.time,
              out.finite ? "" : ", not finite");
  return out;
}

void expect_sound(const drivers::Summary& summary) {
  EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
  EXPECT_TRUE(std::isfinite(value_of(summary, "time_to_rest")));
}

TEST(Scenes, TallColumnsComeToRest) {
  // Lube et al. 2004: runout 1.6 sqrt(a), final height 0.88 a^(1/6).
  for (const double aspect : {10., 20.}) {
    const auto summary =
        run({.aspect = aspect, .spacing = 0.01, .end_time = 3}, fmt::format("aspect ratio {}", aspect));
    expect_sound(summary);
    const double law = 1.6 * std::sqrt(aspect);
    std::printf("runout over that of Lube et al. 2004: %.2f\n", value_of(summary, "runout") / law);
    EXPECT_NEAR(value_of(summary, "runout") / law, 1, 0.35);
  }
}

TEST(Scenes, VeryLooseAndVeryDenseSandComeToRest) {
  const auto loose = run({.void_ratio = 1.2, .spacing = 0.005}, "void ratio 1.2"),
             dense = run({.void_ratio = 0.3, .spacing = 0.005}, "void ratio 0.3");
  for (const auto* summary : {&loose, &dense}) {
    expect_sound(*summary);
    std::printf("void ratio under stress: %.3f to %.3f, mean %.3f\n", value_of(*summary, "void_ratio_least"),
                value_of(*summary, "void_ratio_most"), value_of(*summary, "void_ratio_mean"));
  }
  EXPECT_LT(value_of(loose, "void_ratio_mean"), 0.85) << "loose sand contracts towards the critical 0.75";
  EXPECT_GT(value_of(dense, "void_ratio_mean"), 0.35) << "dense sand dilates";
  EXPECT_LT(value_of(dense, "void_ratio_most"), 0.76);
}

TEST(Scenes, TheNaiveSchemeStandsExtremesButThrowsItsFrontOn) {
  // With this material it does not blow up on them either (a = 10 is alike, and slow): it loses particles at the front.
  for (const double e : {0.3, 1.2}) {
    const ColumnCase c{.void_ratio = e, .spacing = 0.005};
    const auto name = fmt::format("e = {}", e);
    const auto naive = plane_column(c, "naive, " + name, 0.4, [](auto& s) { stability::naive_step(s); });
    const auto ours = plane_column(c, "product, " + name, 0.4, [](auto& s) { host::step(s); });
    EXPECT_LT(std::max(naive.gained, ours.gained), 1e-3);
    EXPECT_GT(naive.front, 1.1 * ours.front);
  }
}

TEST(Scenes, TheNaiveSchemeBlowsUpUnseenAboveTheLimit) {
  const auto naive = plane_column({.spacing = 0.005}, "naive, step factor 2.6", 0.4,
                                  [](auto& s) { stability::naive_step(s, {.step_factor = 2.6}); });
  EXPECT_GT(naive.gained, 1);
}

TEST(Scenes, AStepThatWouldBlowUpIsRefused) {
  const ColumnCase plane{.geometry = "plane_strain", .spacing = 0.005};
  const auto recommended = run(plane, "step factor 0.4");
  int refused = 0, sound = 0;
  for (double factor = 1.2; factor < 3.7; factor += 0.4) {
    try {
      const auto summary = run(plane, fmt::format("step factor {:.1f}", factor), factor);
      ++sound;
      EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
      EXPECT_NEAR(value_of(summary, "final_height"), value_of(recommended, "final_height"), 0.1) << factor;
      // The runout may be off by 0.1 to 0.5 with the energy closed: no guard sees it. Scene files take at most 1.
    } catch (const std::runtime_error& error) {
      ++refused;
      std::printf("step factor %.1f: %.60s\n", factor, error.what());
    }
  }
  EXPECT_GT(refused, 1);
  EXPECT_GT(sound, 1);
}

TEST(Scenes, AxisymmetricStepsAreCutToWhatTheRingAtTheAxisBears) {
  const auto recommended = run({.spacing = 0.005}, "step factor 0.4");
  for (const double factor : {1.2, 2.0, 2.8}) {
    const auto summary = run({.spacing = 0.005}, fmt::format("step factor {:.1f}", factor), factor);
    expect_sound(summary);
    EXPECT_NEAR(value_of(summary, "final_height"), value_of(recommended, "final_height"), 0.03) << factor;
    EXPECT_NEAR(value_of(summary, "runout"), value_of(recommended, "runout"), 0.05) << factor;
  }
}

} // namespace
