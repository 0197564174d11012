// SPDX-License-Identifier: BSD-3-Clause
// A step that is too large never goes unseen: the scene file refuses it, and where it comes in otherwise the run ends
// with particle and time. The counter-case: the same column at the recommended step.
#include "host/geometry.hpp"
#include "host/guard.hpp"
#include "host/simulation.hpp"
#include "tests/verification/scenes.hpp"
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

class StepFactor : public testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(StepFactor, BeyondTheStableIsSeen) {
  const auto [geometry, factor] = GetParam();
  const auto name = fmt::format("guard_{}_{}", geometry, factor);
  auto scene = tests::column_scene({.geometry = geometry, .spacing = 0.005, .end_time = 0.1}, name);
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

INSTANTIATE_TEST_SUITE_P(Guard, StepFactor,
                         testing::Combine(testing::Values("axisymmetric", "plane_strain"),
                                          testing::Values(3.0, 5.0, 10.0)));

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
  const auto run = [](const std::string& numerics) {
    return drivers::run_scene(
        tests::column_scene({.spacing = 0.005, .numerics = numerics, .end_time = 0.3}, "guard_sound"),
        {.quiet = true});
  };
  const auto recommended = run(""), largest = run("step_factor = 1");
  EXPECT_LT(tests::value_of(largest, "energy_imbalance"), 0.001);
  EXPECT_LT(tests::value_of(largest, "steps"), 0.6 * tests::value_of(recommended, "steps"));
  EXPECT_NEAR(tests::value_of(largest, "runout"), tests::value_of(recommended, "runout"), 0.1);
}

TEST(Guard, NamesTheParticleThatStrainsTooMuch) {
  auto s = host::start_simulation<PlaneStrain>(
      tests::column_scene({.geometry = "plane_strain", .spacing = 0.01}, "guard_strain"));
  auto& p = s.particles;
  const double dt = 1e-4, bound = host::largest_strain_step / dt;
  p.velocity_gradient[2][7] = -0.99 * bound;
  EXPECT_EQ(error_of([&] { host::check_strain(p, 0.5, dt); }), "no error");
  p.velocity_gradient[2][7] = -1.01 * bound;
  EXPECT_TRUE(has(error_of([&] { host::check_strain(p, 0.5, dt); }),
                  fmt::format("at time 0.5 s: particle {} at (", p.id[7])));
  p.velocity_gradient[2][7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has(error_of([&] { host::check_strain(p, 0.5, dt); }), "strains by nan"));
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
