// SPDX-License-Identifier: BSD-3-Clause
// A step that is too large never goes unseen: the scene file refuses it, and where it comes in otherwise the run ends
// with particle and time. The counter-case: the same column at the recommended step.
#include "host/engine/guard.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/verification/walls_fixture.hpp"
#include <H5Cpp.h>
#include <omp.h>

namespace {

using host::Axisymmetric, host::PlaneStrain;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class StepFactor : public testing::TestWithParam<double> {};

TEST_P(StepFactor, BeyondTheStableIsSeen) {
  const auto factor = GetParam();
  auto scene = tests::column_scene({.geometry = "plane_strain", .spacing = 0.005, .end_time = 0.1},
                                   fmt::format("guard_{}", factor));
  scene.numerics.step_factor = factor;
  const auto message = error_of([&] { drivers::run_scene(scene, {.quiet = true}); });
  EXPECT_TRUE(has(message, "became unstable at time 0.0") || has(message, "energy went wrong at time 0.0") ||
              has(message, "reported a failure"))
      << message;
  EXPECT_TRUE(has(message, "particle ")) << message;
  EXPECT_FALSE(has(message, "\n"));
  const H5::H5File file(scene.output_folder + "/result.h5", H5F_ACC_RDONLY);
  EXPECT_GE(file.openGroup("snapshots").getNumObjs(), 2) << "the first state and the last";
}

INSTANTIATE_TEST_SUITE_P(Guard, StepFactor, testing::Values(4.0, 5.0, 10.0));

TEST(Guard, TheRingAtTheAxisCutsAxisymmetricStepsThatAreTooLarge) {
  auto scene = tests::column_scene({.spacing = 0.005, .end_time = 0.1}, "guard_ring");
  scene.numerics.step_factor = 10;
  const auto summary = drivers::run_scene(scene, {.quiet = true});
  EXPECT_LT(tests::value_of(summary, "energy_imbalance"), 0.001);
}

TEST(Guard, TheSceneFileTakesNoStepThatCouldGoWrongUnseen) {
  EXPECT_TRUE(has(error_of([] { tests::column_scene({.numerics = "step_factor = 1.5"}, "guard_file"); }),
                  "key 'numerics.step_factor': expected a number from 0.0001 to 1, found 1.5"));
}

TEST(Guard, SofterSandTakesLongerSteps) {
  const auto first_step = [](const std::string& material) {
    const auto scene = tests::column_scene({.spacing = 0.005, .extra = material}, "guard_soft");
    auto s = host::start_simulation<Axisymmetric>(scene);
    host::step(s);
    return s.first_dt;
  };
  EXPECT_NEAR(first_step("stiffness_scale = 0.25") / first_step(""), 2, 1e-3);
  EXPECT_EQ(first_step("stiffness_scale = 1"), first_step(""));
  const auto refused = [&](const std::string& value) {
    return error_of([&] { first_step("stiffness_scale = " + value); });
  };
  EXPECT_TRUE(
      has(refused("1.5"), "key 'material.stiffness_scale': expected a number from 0.001 to 1, found 1.5"));
  EXPECT_TRUE(has(
      refused("0.1\nK0 = 5"),
      "key 'material.stiffness_scale': expected a number that leaves K0 at 1 or more, found 0.1 for K0 = 5"));
}

TEST(Guard, TheLargestStepOfASceneFileIsSound) {
  omp_set_num_threads(1);
  const auto run = [](const std::string& geometry, const std::string& numerics) {
    const tests::ColumnCase scene{
        .geometry = geometry, .spacing = 0.005, .numerics = numerics, .end_time = 0.3};
    return drivers::run_scene(tests::column_scene(scene, "guard_sound"), {.quiet = true});
  };
  for (const std::string geometry : {"plane_strain", "axisymmetric"}) {
    const auto recommended = run(geometry, ""), largest = run(geometry, "step_factor = 1");
    EXPECT_LT(tests::value_of(largest, "energy_imbalance"), 0.001) << geometry;
    // In axisymmetry the ring next to the axis keeps the step from growing as much.
    EXPECT_LT(tests::value_of(largest, "steps"),
              (geometry == "plane_strain" ? 0.6 : 1) * tests::value_of(recommended, "steps"));
    EXPECT_NEAR(tests::value_of(largest, "runout"), tests::value_of(recommended, "runout"), 0.1) << geometry;
  }
}

TEST(Guard, NamesTheParticleThatStrainsTooMuch) {
  auto s = host::start_simulation<PlaneStrain>(
      tests::column_scene({.geometry = "plane_strain", .spacing = 0.01}, "guard_strain"));
  auto& p = s.particles;
  const double dt = 1e-4, bound = host::largest_strain_step / dt;
  host::BlockGradient<PlaneStrain> gradient{};
  const auto check = [&](double slope) {
    gradient.component[2][7] = slope;
    return error_of([&] { host::check_strain(p, gradient, 3, 12, 0.5, dt); });
  };
  EXPECT_EQ(check(-0.99 * bound), "no error");
  EXPECT_TRUE(has(check(-1.01 * bound), fmt::format("at time 0.5 s: particle {} at (", p.id[10])));
  EXPECT_TRUE(has(check(std::numeric_limits<double>::quiet_NaN()), "strains by nan"));
}

/// A plane wall with friction, in the plane.
std::string ground(double height, const std::string& more = "") {
  return fmt::format("[[wall]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, {}]\nnormal = [0, 1]\n"
                     "friction = 0.3\n{}",
                     height, more);
}

host::Scene column_on(double base, const std::string& walls, const std::string& name) {
  return tests::wall_scene(
      {.column = fmt::format("radius = 0.025\nheight = 0.05\nsymmetric = false\nbase = {}", base),
       .material = tests::sand("TS", 0.4451),
       .walls = walls,
       .spacing = 0.005,
       .end_time = 0.5},
      name);
}

TEST(Guard, SeesWorkOfWhatOnlyTakes) {
  auto s = host::start_simulation<PlaneStrain>(column_on(0, ground(0), "guard_work"));
  const double e0 = host::energy_scale(s);
  const auto check = [&](double host::Work::*kind, double share) {
    s.work = {};
    s.work.*kind = share * e0;
    return error_of([&] { host::check_work(s); });
  };
  EXPECT_EQ(check(&host::Work::viscosity, -1), "no error");
  EXPECT_EQ(check(&host::Work::stress, 0.049), "no error");
  EXPECT_TRUE(has(check(&host::Work::viscosity, 0.0011), "artificial viscosity gave the sand 0.0011 of"));
  EXPECT_TRUE(has(check(&host::Work::stress, 0.051),
                  "at time 0 s: the stress of pairs and walls gave the sand 0.051 of the"));
  EXPECT_TRUE(has(check(&host::Work::stress, NAN), "the stress of pairs and walls gave the sand nan"));
  s.work = {};
  s.loads[0].work = 0.031 * e0;
  const auto by_wall = error_of([&] { host::check_work(s); });
  EXPECT_TRUE(has(by_wall, "the wall 'ground' at rest gave the sand 0.031 of")) << by_wall;
  EXPECT_TRUE(has(by_wall, "numerics.step_factor"));
  s.walls[0].motion = s.scene.walls[0].motion = {{0, 1}, {{}, {}}};
  s.work.stress = e0;
  EXPECT_TRUE(
      has(error_of([&] { host::check_work(s); }), "the stress of pairs and walls gave the sand 1 of"));
  s.loads[0].given = e0;
  EXPECT_EQ(error_of([&] { host::check_work(s); }), "no error") << "a wall that moves may give";
  s.work.stress = 1.11 * e0;
  EXPECT_TRUE(
      has(error_of([&] { host::check_work(s); }), "the stress of pairs and walls gave the sand 0.055 of"));
}

/// Pairs made several times the energy of the start, and viscosity took it, unseen.
TEST(Guard, NoDroppedColumnGainsEnergyUnseen) {
  for (const double factor : {0.4, 1.0, 2.0}) {
    auto scene = column_on(0.2, ground(0), fmt::format("guard_drop_{}", factor));
    scene.numerics.step_factor = factor;
    drivers::Summary summary;
    const auto message = error_of([&] { summary = drivers::run_scene(scene, {.quiet = true}); });
    std::printf("step factor %g: %s\n", factor, message.c_str());
    if (message == "no error") {
      EXPECT_LE(tests::value_of(summary, "work_stress"), 0.5);
      EXPECT_LE(tests::value_of(summary, "work_wall"), 0.03);
    } else
      EXPECT_TRUE(has(message, "energy went wrong at time 0.") || has(message, "became unstable at time 0."))
          << message;
  }
}

TEST(Guard, ComparesWithEnergyAboveTheLowestFloor) {
  const auto scale = [](double base, const std::string& walls) {
    return host::energy_scale(host::start_simulation<PlaneStrain>(column_on(base, walls, "guard_scale")));
  };
  const double low = scale(0, ground(0));
  EXPECT_EQ(
      low,
      host::start_simulation<PlaneStrain>(column_on(0, ground(0), "guard_scale")).initial_potential_energy);
  EXPECT_NEAR(scale(2, ground(2)), low, 1e-9 * low);
  EXPECT_NEAR(scale(2, ground(2) + "[floor]\nfriction = 0.3\n"), low, 1e-9 * low);
  EXPECT_NEAR(scale(0.2, ground(0)), 9 * low, 1e-9 * low) << "a fall of four column heights";
  EXPECT_NEAR(scale(2, ground(2, "times = [0, 0.1]\nvelocity_z = [-1, -1]\n")), 5 * low, 1e-9 * low)
      << "a floor that sinks by 0.1 m";
  const std::string box = "[[wall]]\nname = \"box\"\nshape = \"box\"\nside = \"inside\"\nlower = [-1, 1.5]\n"
                          "upper = [1, 9]\nfriction = 0\n";
  EXPECT_NEAR(scale(1.5, box), low, 1e-9 * low);
}

TEST(Guard, NamesTheFastestParticleWhereEnergyIsMadeOrLost) {
  auto s = host::start_simulation<Axisymmetric>(tests::column_scene({.spacing = 0.01}, "guard_energy"));
  auto& p = s.particles;
  p.velocity[1][5] = -3;
  const auto check = [&](double made, double unclosed) {
    return error_of([&] { host::check_energy(p, 0.25, made, unclosed); });
  };
  EXPECT_EQ(check(-1, 0.004), "no error");
  EXPECT_EQ(check(0.019, -0.004), "no error");
  for (const auto& message :
       {check(0.021, 0), check(0, 0.006), check(0, -0.006), check(NAN, 0), check(0, NAN)})
    EXPECT_TRUE(has(message, fmt::format("at time 0.25 s")) &&
                has(message, fmt::format("particle {} at (", p.id[5])) && has(message, "with 3 m/s"))
        << message;
}

} // namespace
