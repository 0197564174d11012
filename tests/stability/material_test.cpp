// SPDX-License-Identifier: BSD-3-Clause
// Faults of the material that a point shows and a column suffers from: dilatancy at the trial state, gaps forgotten.
#include "host/engine/metrics.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/stability/naive_sand.hpp"
#include "tests/stability/naive_scheme.hpp"
#include "tests/verification/scenes.hpp"
#include <algorithm>
#include <random>

namespace {

using namespace stability;
using charts::Point, charts::Tensor;

const charts::Material sand = charts::material_of(charts::properties(charts::sands[1]));

Tensor isotropic(double s) {
  return simsand::add_mean(Tensor{}, s);
}

/// Mean stress after shear noise of no volume change on loose sand at 1 Pa, which can only contract.
template <class Update> double pumped(Update&& update) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Point point{isotropic(1), sand.given.e_ref + 0.05, 0, 0};
  for (int i = 0; i < 200; ++i) {
    Tensor strain;
    for (int c = 0; c < 6; ++c) strain[c] = 1e-4 * normal(random);
    point = update(point, simsand::deviator(strain));
  }
  return charts::mean(point.stress);
}

TEST(Material, ShearNoiseNearTheApexPumpsNoPressure) {
  faults = {.trial_dilatancy = true};
  const double naive = pumped([](const Point& p, const Tensor& d) { return naive_update(sand, p, d); });
  const double ours =
      pumped([](const Point& p, const Tensor& d) { return simsand::update(sand, p, d).state; });
  std::printf("mean stress after 200 bursts from 1 Pa: trial state %.3g Pa, ours %.3g Pa\n", naive, ours);
  EXPECT_GT(naive, 10);
  EXPECT_LE(ours, 1 + 1e-9);
}

/// Mean stress left of 1 kPa after cycles of extension and compression by 1 % in volume.
template <class Update> Point cycled(Update&& update) {
  Point point{isotropic(1e3), 0.6, 0.01, 0};
  for (int i = 0; i < 20; ++i) {
    point = update(point, isotropic(-0.01 / 3));
    point = update(point, isotropic(0.01 / 3));
  }
  return point;
}

TEST(Material, PartingAndMeetingAgainReturnsTheStress) {
  faults = {.no_gap = true};
  const auto naive = cycled([](const Point& p, const Tensor& d) { return naive_update(sand, p, d); });
  const auto ours = cycled([](const Point& p, const Tensor& d) { return simsand::update(sand, p, d).state; });
  std::printf("mean stress after 20 cycles from 1000 Pa: gap forgotten %.6g Pa, ours %.6g Pa\n",
              charts::mean(naive.stress), charts::mean(ours.stress));
  EXPECT_GT(charts::mean(naive.stress), 1e4);
  EXPECT_NEAR(charts::mean(ours.stress), 1e3, 1e-5);
}

/// What a column of dense sand becomes: void ratio of what carries stress, height.
struct Deposit {
  double median_void_ratio = 0, highest_void_ratio = 0, height = 0;
  std::string failure{};
};
Deposit collapse(const std::string& name, vumat::Subroutine<double>* material) {
  auto scene = tests::column_scene(
      {.geometry = "plane_strain", .material = "SS", .void_ratio = 0.58, .spacing = 0.005}, name);
  if (material) scene.material.library.call = material;
  auto s = host::start_simulation<host::PlaneStrain>(scene);
  Deposit deposit;
  try {
    while (s.time < 0.4) host::step(s);
  } catch (const std::runtime_error& error) {
    deposit.failure = error.what();
  }
  std::vector<double> e;
  for (int i = 0; i < s.particles.count; ++i)
    if (host::mean_pressure(s.particles, i) > 20)
      e.push_back(s.particles.state[simsand::statev::void_ratio][i]);
  std::ranges::sort(e);
  const auto radii = host::outline_radii(scene.spacing, 0.4);
  if (e.empty()) e.push_back(s.particles.state[simsand::statev::void_ratio][0]);
  deposit.median_void_ratio = e[e.size() / 2];
  deposit.highest_void_ratio = e.back();
  deposit.height = host::outline_height(host::outline(s.particles, s.kernel, radii)) / 0.05;
  return deposit;
}

TEST(Material, AColumnOfDenseSandDoesNotPumpItselfLoose) {
  const double critical = 0.76;
  const auto ours = collapse("stability_ours", nullptr);
  faults = {.trial_dilatancy = true};
  const auto trial = collapse("stability_trial", naive_vumat);
  faults = {.no_gap = true};
  const auto gapless = collapse("stability_no_gap", naive_vumat);
  const auto print = [](const char* name, const Deposit& d) {
    std::printf("%-32s void ratio: median %.3f, most %.3f; h_f/r0 %.3f %s\n", name, d.median_void_ratio,
                d.highest_void_ratio, d.height, d.failure.c_str());
  };
  print("ours", ours);
  print("dilatancy of the trial state", trial);
  print("gap forgotten", gapless);
  EXPECT_LT(ours.median_void_ratio, critical);
  EXPECT_LT(ours.highest_void_ratio, critical + 0.05);
  EXPECT_GT(trial.median_void_ratio, critical);
  EXPECT_GT(gapless.highest_void_ratio, critical + 0.05);
}

} // namespace
