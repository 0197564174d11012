// SPDX-License-Identifier: BSD-3-Clause
// Three treatments of nearly stress-free sand that look harmless and spoil every run: each test fails where
// its treatment is the wrong one.
#include "tests/unit/vumat_fixture.hpp"
#include <gtest/gtest.h>

namespace {

using namespace vumat_test;
using simsand::Status;

// 1. Dilatancy (9) at the stress ratio of the elastic trial, which has no bound as p goes to 0.

TEST(VumatTraps, ShearNoisePumpsNoPressureOutOfCriticalSand) {
  // At and above the critical void ratio the yield surface lies nowhere above M_pt: shear without change of
  // volume can only lower the pressure.
  const auto m = material(SS);
  std::mt19937_64 random(5);
  for (const double p : {0.01, 1., 100.})
    for (const double strain : {1e-6, 1e-5, 1e-4}) {
      State6 point{isotropic(p), m.given.e_ref, 0, 0};
      for (int i = 0; i < 200; ++i) {
        point = simsand::update(m, point, simsand::scale(strain, random_deviator(random))).state;
        ASSERT_LE(mean(point.stress), p * (1 + 1e-9)) << "strain " << strain << ", burst " << i;
      }
    }
}

TEST(VumatTraps, DilationOfDenseSandIsThatOfItsYieldSurface) {
  const auto m = material(SS);
  std::mt19937_64 random(6);
  for (const double p : {0.01, 1., 100.})
    for (const double strain : {1e-5, 1e-3}) {
      const State6 old{isotropic(p), 0.58, 0.01, 0};
      const auto after = simsand::update(m, old, simsand::scale(strain, random_deviator(random)));
      ASSERT_GE(int(after.status), 0);
      // Volume is kept, so the elastic compression is the plastic dilation, strain for strain.
      const double y0 = simsand::pressure_of_mean_stress(m, p).measure;
      const double y1 = simsand::pressure_of_mean_stress(m, mean(after.state.stress)).measure;
      const double dilation = (y1 - y0) / (m.given.K0 * simsand::void_ratio_factor(0.58));
      const double multiplier = after.state.plastic_strain - old.plastic_strain;
      const auto M = simsand::slopes(m, 0.58, simsand::pressure_of_mean_stress(m, 0.), -1.); // largest M_p
      EXPECT_LE(dilation, (M.peak - 0) * m.given.A_d * multiplier * (1 + 1e-9) + 1e-15);
      EXPECT_GE(dilation, -M.transformation * m.given.A_d * multiplier - 1e-15);
    }
}

// 2. Separation: strain that parts the grains must be closed before stress returns.

TEST(VumatTraps, SeparationReturnsTheStressItTook) {
  const auto m = material(SS);
  for (const double p : {0.5, 1e2, 1e4})
    for (const int steps : {1, 7, 1000}) {
      const State6 start{isotropic(p), 0.6, 0.01, 0};
      State6 point = start;
      for (int cycle = 0; cycle < 3; ++cycle) {
        for (int i = 0; i < steps; ++i) point = simsand::update(m, point, isotropic(-0.01 / 3 / steps)).state;
        EXPECT_EQ(mean(point.stress), 0);
        EXPECT_GT(point.separation_strain, 0);
        for (int i = 0; i < 3; ++i) point = simsand::update(m, point, isotropic(0.01 / 9)).state;
        EXPECT_NEAR(mean(point.stress), p, 1e-8 * p);
        EXPECT_NEAR(point.void_ratio, 0.6, 1e-12);
        EXPECT_EQ(point.separation_strain, 0);
      }
    }
}

TEST(VumatTraps, PartedGrainsCarryNoStressUntilTheyMeet) {
  const auto m = material(SS);
  auto point = simsand::update(m, State6{isotropic(1e3), 0.6, 0.01, 0}, isotropic(-0.01)).state;
  const double gap = point.separation_strain;
  auto free = simsand::update(m, point, Tensor6{{0.3 * gap, 0, 0, 0.1}});
  EXPECT_EQ(free.status, Status::stress_free);
  EXPECT_EQ(mean(free.state.stress), 0);
  EXPECT_NEAR(free.state.separation_strain, 0.7 * gap, 1e-15);
  EXPECT_EQ(free.state.plastic_strain, point.plastic_strain);
  free = simsand::update(m, free.state, isotropic(-0.001));
  EXPECT_NEAR(free.state.separation_strain, 0.7 * gap + 0.003, 1e-15);

  // Of an increment that closes the gap, only what is left loads.
  const double left = 1e-4;
  const auto closed = simsand::update(m, point, isotropic((gap + left) / 3));
  const State6 touching{Tensor6{}, simsand::void_ratio_after(point.void_ratio, gap), 0.01, 0};
  const auto loaded = simsand::update(m, touching, isotropic(left / 3));
  EXPECT_GT(mean(loaded.state.stress), 0);
  EXPECT_NEAR(mean(closed.state.stress), mean(loaded.state.stress), 1e-9 * mean(loaded.state.stress));
}

TEST(VumatTraps, AGapThatClosesExactlyIsStressFree) {
  const auto m = material(SS);
  const double part = 0x1p-20;
  const auto closed = simsand::update(m, State6{Tensor6{}, 0.6, 0.01, 3 * part}, isotropic(part));
  EXPECT_EQ(closed.status, Status::stress_free);
  EXPECT_EQ(mean(closed.state.stress), 0);
  EXPECT_GT(closed.state.separation_strain, 0);
  EXPECT_LT(closed.state.separation_strain, 1e-300);
  EXPECT_GT(mean(simsand::update(m, closed.state, isotropic(part)).state.stress), 0);
}

TEST(VumatTraps, NoShearStressOutlivesTheMeanStress) {
  const auto m = material(SS);
  const auto s = simsand::scale(300., Tensor6{{2. / 3, -1. / 3, -1. / 3}});
  const auto start = simsand::initial_state(m, simsand::add_mean(s, 1e3), 0.7);
  const auto after = simsand::update(m, start, isotropic(-0.01));
  EXPECT_EQ(after.status, Status::stress_free);
  EXPECT_EQ(q_of(after.state.stress), 0);
  // A host's stress beside an open gap is not believed.
  State6 smoothed = after.state;
  smoothed.stress = isotropic(50);
  EXPECT_EQ(mean(simsand::update(m, smoothed, Tensor6{}).state.stress), 0);
  // Nor is a shear stress beside a mean tension.
  const State6 none{Tensor6{}, 0.7, 0.01, 0}, tensile{simsand::add_mean(s, -50.), 0.7, 0.01, 0};
  const auto a = simsand::update(m, none, isotropic(1e-5)).state,
             b = simsand::update(m, tensile, isotropic(1e-5)).state;
  for (int c = 0; c < 6; ++c) EXPECT_EQ(a.stress[c], b.stress[c]);
  EXPECT_EQ(a.plastic_strain, b.plastic_strain);
}

// 3. The floor of pressure in the moduli is a cohesion where it is not small.

TEST(VumatTraps, ExtensionReachesZeroPressureAtTheStrainOfThePowerLaw) {
  const auto m = material(SS);
  EXPECT_DOUBLE_EQ(m.given.p_min, 1e-5 * p_at);
  for (const double p : {1e2, 1e3, 1e4}) {
    const double K = simsand::bulk_modulus(m, 0.6, simsand::pressure_of_mean_stress(m, p));
    const auto parted = simsand::update(m, State6{isotropic(p), 0.6, 0, 0}, isotropic(-0.01 / 3)).state;
    const double needed = 0.01 - parted.separation_strain;
    // The floor shortens the strain by p_min^(1-n) n / p^(1-n), the change of e by a few times itself.
    const double floor_share = 0.51 * std::pow(m.given.p_min / p, 0.49);
    EXPECT_NEAR(needed, p / (K * (1 - 0.51)) * (1 - floor_share), 4 * needed * needed);
  }
}

TEST(VumatTraps, TheFloorGivesNoStrengthAndNoTension) {
  auto given = parameters_of(SS, 0.58);
  given.p_min = 1e3; // the most sticky floor in use
  const simsand::Material<double> m(given);
  std::mt19937_64 random(8);
  for (const double p : {1e-3, 1., 100., 900.}) {
    State6 point{isotropic(p), 0.7, 0, 0};
    for (int i = 0; i < 50; ++i) {
      point = simsand::update(m, point, simsand::scale(1e-4, random_deviator(random))).state;
      const double now = mean(point.stress);
      ASSERT_GE(now, 0);
      ASSERT_LE(q_of(point.stress), 1.2 * now); // M_p(0.7, 0) is 0.93
    }
    const auto parted = simsand::update(m, point, isotropic(-0.01)).state;
    EXPECT_EQ(mean(parted.stress), 0);
    EXPECT_EQ(q_of(parted.stress), 0);
  }
}

} // namespace
