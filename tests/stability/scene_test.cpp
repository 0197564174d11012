// SPDX-License-Identifier: BSD-3-Clause
// Extreme scenes, on coarse grids: cohesion by p_min, tall columns, very loose and very dense sand, steps up to and
// beyond the limit, the toe of the deposit.
#include "host/metrics.hpp"
#include "host/output.hpp"
#include "tests/stability/naive_scheme.hpp"
#include "tests/verification/scenes.hpp"
#include <H5Cpp.h>

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
  std::printf("%-18s h_f/r0 %.3f, runout %.3f, rest after %.2f s, energy off by %.1g\n", name.c_str(),
              value_of(summary, "final_height"), value_of(summary, "runout"), value_of(summary, "time_to_rest"),
              value_of(summary, "energy_imbalance"));
  return summary;
}

TEST(Scenes, CohesionByTheFloorOfPressure) {
  for (const char* p_min : {"0.1", "1", "10", "100", "1000"})
    for (const double factor : {0.4, 0.38, 0.36})
    run({.spacing = 0.005, .extra = fmt::format("p_min = {}", p_min)}, fmt::format("p_min_{}", p_min), factor);
}

TEST(Scenes, TallColumns) {
  for (const double aspect : {10., 20.}) {
    const auto summary = run({.aspect = aspect, .spacing = 0.01, .end_time = 3}, fmt::format("tall_{}", aspect));
    EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
  }
}

TEST(Scenes, VeryLooseAndVeryDenseSand) {
  for (const double e : {1.2, 0.3}) {
    const auto summary = run({.void_ratio = e, .spacing = 0.005}, fmt::format("void_ratio_{}", e));
    EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
    std::printf("void ratio least %.3f mean %.3f most %.3f\n", value_of(summary, "void_ratio_least"), value_of(summary, "void_ratio_mean"), value_of(summary, "void_ratio_most"));
  }
}

TEST(Scenes, NoStepGoesWrongUnseen) {
  const auto recommended = run({.spacing = 0.005}, "step_0.4");
  for (double factor = 1; factor < 3; factor += 0.1) {
    try {
      run({.spacing = 0.005}, fmt::format("step_{:.1f}", factor), factor);
    } catch (const std::runtime_error& error) {
      std::printf("step factor %.1f: %.90s\n", factor, error.what());
    }
  }
}

} // namespace
