// SPDX-License-Identifier: BSD-3-Clause
// The update of one point against closed forms, an independent integration of the rate equations, and
// properties that hold for any state.
#include "tests/unit/vumat_fixture.hpp"
#include <gtest/gtest.h>

namespace {

using namespace vumat_test;
using simsand::Status;

/// Rate equations (1)-(11) of a point that yields: the state and its derivative along a strain rate. The
/// multiplier follows from the consistency condition with directional differences of (8).
struct Rate {
  Tensor6 stress;
  double e, eps_d;
};

State6 moved(const State6& a, double h, const Rate& r) {
  return {simsand::add(a.stress, h, r.stress), a.void_ratio + h * r.e, a.plastic_strain + h * r.eps_d, 0};
}

Rate rate(const simsand::Material<double>& m, const State6& a, const Tensor6& strain_rate) {
  const double p = mean(a.stress), q = q_of(a.stress);
  const auto s = simsand::deviator(a.stress);
  const auto pressure = simsand::pressure_of_mean_stress(m, p);
  const double K = simsand::bulk_modulus(m, a.void_ratio, pressure), G = m.shear_ratio * K;
  const double D =
      m.given.A_d *
      (simsand::slopes(m, a.void_ratio, pressure, simsand::sin_3theta(s, q)).transformation - q / p);
  const double volumetric = simsand::trace(strain_rate);
  const Rate elastic{simsand::add_mean(simsand::scale(2 * G, simsand::deviator(strain_rate)), K * volumetric),
                     -(1 + a.void_ratio) * volumetric, 0};
  const Rate plastic{simsand::add_mean(simsand::scale(-3 * G / q, s), -K * D), 0, 1};
  const auto slope = [&](const Rate& r) {
    const double h = 1e-6 * p / (q_of(r.stress) + std::abs(mean(r.stress)) + p * r.eps_d / m.given.k_p);
    return (yield_of(m, moved(a, h, r)) - yield_of(m, moved(a, -h, r))) / (2 * h);
  };
  const double x = -slope(elastic) / slope(plastic);
  return {simsand::add(elastic.stress, x, plastic.stress), elastic.e, x};
}

State6 runge_kutta(const simsand::Material<double>& m, State6 a, const Tensor6& strain, int steps) {
  const double h = 1.0 / steps;
  for (int i = 0; i < steps; ++i) {
    const Rate k1 = rate(m, a, strain), k2 = rate(m, moved(a, h / 2, k1), strain);
    const Rate k3 = rate(m, moved(a, h / 2, k2), strain), k4 = rate(m, moved(a, h, k3), strain);
    a = moved(moved(moved(moved(a, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  }
  return a;
}

State6 in_increments(const simsand::Material<double>& m, State6 a, const Tensor6& strain, int steps) {
  for (int i = 0; i < steps; ++i) a = simsand::update(m, a, simsand::scale(1.0 / steps, strain)).state;
  return a;
}

/// A point on the yield surface at half of its peak strength, in triaxial compression.
State6 half_mobilised(const simsand::Material<double>& m, double p, double e) {
  const auto M = simsand::slopes(m, e, simsand::pressure_of_mean_stress(m, p), -1.);
  const double q = M.peak * p / 2;
  return simsand::initial_state(m, simsand::add_mean(Tensor6{{2 * q / 3, -q / 3, -q / 3}}, p), e);
}

TEST(VumatUpdate, FollowsTheRateEquationsAlongATurningPath) {
  for (const auto& shape : shapes)
    for (const double e : {shape.dense, 0.8}) {
      const auto m = material(shape);
      const State6 start = half_mobilised(m, 2e3, e);
      // Mostly axial, with shear that turns the principal axes; loose sand is let contract, or it would lose
      // its stress.
      const Tensor6 turning{{4.5e-3, -3.2e-3, -1.3e-3, 1e-3, 5e-4, -7e-4}};
      const Tensor6 strain = simsand::add_mean(turning, e > shape.e_ref ? 1e-3 : 0);
      const auto exact = runge_kutta(m, start, strain, 2000);
      const auto close = in_increments(m, start, strain, 500);
      const auto coarse = in_increments(m, start, strain, 10);
      for (int c = 0; c < 6; ++c) {
        EXPECT_NEAR(close.stress[c], exact.stress[c], 1e-3 * q_of(exact.stress));
        EXPECT_NEAR(coarse.stress[c], exact.stress[c], 2e-2 * q_of(exact.stress));
      }
      EXPECT_NEAR(close.void_ratio, exact.void_ratio, 1e-9);
      EXPECT_NEAR(close.plastic_strain, exact.plastic_strain, 1e-3 * exact.plastic_strain);
    }
}

TEST(VumatUpdate, IsOfSecondOrderWhereTheDeviatorDoesNotTurn) {
  const auto m = material(SS);
  const State6 start = half_mobilised(m, 2e3, 0.58);
  const Tensor6 strain{{4e-3, -2.2e-3, -2.2e-3}};
  const double exact = q_of(runge_kutta(m, start, strain, 4000).stress);
  const double coarse = q_of(in_increments(m, start, strain, 10).stress) - exact;
  const double fine = q_of(in_increments(m, start, strain, 20).stress) - exact;
  EXPECT_GT(std::abs(coarse / fine), 3.5);
  EXPECT_LT(std::abs(coarse), 1e-3 * exact);
}

TEST(VumatUpdate, ErrorOfATurningDeviatorFallsNearlyWithTheSquareOfTheStep) {
  const auto m = material(SS);
  const State6 start = half_mobilised(m, 2e3, 0.58);
  const Tensor6 strain{{1e-4, -1e-4, 0, 4e-4, 0, -2e-4}};
  const auto exact = runge_kutta(m, start, strain, 4000).stress;
  const auto error = [&](int steps) {
    return q_of(simsand::add(in_increments(m, start, strain, steps).stress, -1., exact));
  };
  EXPECT_GT(error(10) / error(20), 3);
  EXPECT_GT(error(20) / error(40), 2.7);
  EXPECT_LT(error(20), 1e-3 * q_of(exact));
}

TEST(VumatUpdate, EndsAtTheCriticalState) {
  const std::array slope_at_critical{0.7097, 0.9411, 1.0268}; // 6 sin phi / (3 - sin phi)
  for (int i = 0; i < 3; ++i)
    for (const double e0 : {shapes[i].dense, 0.85}) {
      const auto m = material(shapes[i]);
      const double cell = 5e3;
      State6 point{isotropic(cell), e0, 0, 0};
      double lateral = 0;
      for (int step = 0; step < 4000; ++step) { // axial strain 1e-3 each, lateral stress held by secants
        const auto at = [&](double l) { return simsand::update(m, point, Tensor6{{1e-3, l, l}}).state; };
        double a = lateral, b = lateral - 1e-6, fa = at(a).stress[1] - cell, fb = at(b).stress[1] - cell;
        for (int k = 0; k < 50 && std::abs(fb) > 1e-8 * cell && fb != fa; ++k) {
          const double next = b - fb * (b - a) / (fb - fa);
          a = b;
          fa = fb;
          b = next;
          fb = at(b).stress[1] - cell;
        }
        point = at(lateral = b);
        ASSERT_NEAR(point.stress[1], cell, 1e-6 * cell);
      }
      const double p = mean(point.stress);
      EXPECT_NEAR(q_of(point.stress) / p, slope_at_critical[i], 1e-3 * slope_at_critical[i]);
      EXPECT_NEAR(point.void_ratio, shapes[i].e_ref - 0.04 * std::pow(p / p_at, 0.3), 2e-4);
    }
}

TEST(VumatUpdate, ReturnsFromElasticCyclesWhateverTheIncrements) {
  const auto m = material(TS);
  State6 point{isotropic(1e3), 0.6, 0, 0};
  for (int i = 0; i < 10; ++i) point = simsand::update(m, point, isotropic(1e-3)).state;
  point = simsand::update(m, point, isotropic(-6e-3)).state;
  for (int i = 0; i < 1000; ++i) point = simsand::update(m, point, isotropic(-4e-6)).state;
  EXPECT_NEAR(mean(point.stress), 1e3, 1e-6);
  EXPECT_NEAR(point.void_ratio, 0.6, 1e-12);
  EXPECT_EQ(point.plastic_strain, 0);
}

TEST(VumatUpdate, FirstCallPlacesTheStressOnTheYieldSurface) {
  std::mt19937_64 random(7);
  const auto m = material(SS);
  for (int i = 0; i < 100; ++i) {
    const auto s = random_deviator(random);
    const double p = 1e3, eta = 0.01 * i;
    const auto point = simsand::initial_state(m, simsand::add_mean(simsand::scale(eta * p, s), p), 0.58);
    const auto M =
        simsand::slopes(m, 0.58, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(s, 1.));
    if (eta < 0.98 * M.peak) {
      EXPECT_NEAR(point.plastic_strain, m.given.k_p * eta / (M.peak - eta), 1e-9);
      EXPECT_NEAR(yield_of(m, point), 0, 1e-9 * p);
    }
    const auto updated = simsand::update(m, point, Tensor6{}); // beyond M_p: returned, never above
    EXPECT_GE(int(updated.status), 0);
    EXPECT_LE(yield_of(m, updated.state), 1e-6 * mean(updated.state.stress));
  }
  EXPECT_EQ(simsand::initial_state(m, isotropic(1e3), 0.58).plastic_strain, 0);
  EXPECT_EQ(mean(simsand::initial_state(m, isotropic(-1e3), 0.58).stress), 0);
}

TEST(VumatUpdate, CountsOnlyPlasticUpdatesBeyondTheConvexRange) {
  const auto dense = material(TS); // 0.44 at low stress: 56 degrees and more
  const auto point = half_mobilised(dense, 2e3, 0.44);
  const Tensor6 loading{{1e-4, -5e-5, -5e-5}};
  EXPECT_TRUE(simsand::update(dense, point, loading).nonconvex);
  EXPECT_FALSE(simsand::update(dense, point, simsand::scale(-0.01, loading)).nonconvex);
  EXPECT_FALSE(simsand::update(material(SS), half_mobilised(material(SS), 2e3, 0.7), loading).nonconvex);
}

TEST(VumatUpdate, BadStatesFailAndChangeNothing) {
  const auto m = material(SS);
  const State6 good{isotropic(1e3), 0.6, 0.01, 0};
  const Tensor6 strain{{1e-4, 0, 0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (State6 bad : {State6{isotropic(nan), 0.6, 0, 0}, State6{isotropic(1), nan, 0, 0},
                     State6{isotropic(1), -0.1, 0, 0}, State6{isotropic(1), 0.6, -1e-3, 0}})
    EXPECT_EQ(simsand::update(m, bad, strain).status, Status::bad_input);
  const auto failed = simsand::update(m, good, Tensor6{{nan, 0, 0}});
  EXPECT_EQ(failed.status, Status::bad_input);
  EXPECT_EQ(failed.state.void_ratio, good.void_ratio);
}

TEST(VumatUpdate, ContractionAtZeroPressureIsNotLeaptOver) {
  // Shear at constant volume that would dilate at its end, but contracts first: no stress can arise.
  const auto m = material(TS);
  const Tensor6 shear{{-0.021844805076736393, -0.002714531135492053, 0.024559336212228448,
                       -0.022770329361894947, 0.0069086007978424431, 0.015801482398705866}};
  const auto after = simsand::update(m, State6{{}, 0.68711157054898142, 0.0039891691249632228, 0}, shear);
  EXPECT_EQ(after.status, Status::stress_free);
  EXPECT_EQ(simsand::trace(after.state.stress), 0);
}

TEST(VumatUpdate, DirectionOfASofterTrialIsCutIntoSubsteps) {
  // Extension that dilation makes up for: the trial, of half the shear modulus, turns the deviator too far, and M with it.
  const auto m = material(SS);
  const State6 start{{{50306.590327650796, 6029.6949182611243, 312876.62536793621, 23700.892507186847, 0, 0}},
                     0.33813655446441826,
                     0.22590929603669402,
                     0};
  const Tensor6 strain{
      {-0.010986566404064356, -0.0092504472537868147, 0.003949340499936488, -0.0025990607555818183, 0, 0}};
  const int parts = 4096;
  State6 fine = start;
  for (int i = 0; i < parts; ++i) fine = simsand::update(m, fine, simsand::scale(1. / parts, strain)).state;
  const auto off = simsand::add(simsand::update(m, start, strain).state.stress, -1., fine.stress);
  const auto size = [](const Tensor6& t) { return std::sqrt(simsand::contract(t, t)); };
  EXPECT_LT(size(off), 0.05 * size(fine.stress)); // 0.11 without the term of (20) for it
}

TEST(VumatUpdate, RoundingOfAnIsotropicStressHasNoDirection) {
  // A third of all mean stresses leave a deviator of 1e-16 p, which is no shear that the flow could turn from.
  const auto m = material(SS);
  for (int i = 0; i < 100; ++i) {
    const double p = 1000 + 0.1 * i;
    const State6 isotropic{{{p, p * (1 + 2e-16), p, 0, 0, 1e-16 * p}}, 0.58, 0, 0};
    const auto after = simsand::update(m, isotropic, {{1e-6, -1e-6, 1e-6, 1e-6, 0, 0}});
    EXPECT_EQ(after.status, Status::plastic) << p;
  }
}

TEST(VumatUpdate, ATrialThatSeriesTakeForElasticIsReturned) {
  // Compression by many times the stress: e_c and e fall by nearly the same, and the slope of e_c changes on the way.
  struct Found {
    Shape shape;
    State6 point;
    Tensor6 strain;
  };
  const std::array found{Found{ES,
                               {{{99844.140129214138, 57428.604181613155, 75454.403200205968,
                                  -5219.5748881872678, -8002.6464444699168, 1224.8840680713934}},
                                0.73294702439534232,
                                0.0072283806457503711,
                                0},
                               {{0.0056804322034110987, 0.007154151979380614, 0.005162386971347464,
                                 -0.004415443568052969, -0.00098020986969437848, 0.00054082757458102698}}},
                         Found{TS,
                               {{{0.00084753315924204103, 0.0013223948297033036, 0.0010532041767855338,
                                  0.00022098862840928666, 9.0466128918331194e-05, 0.00049453767766315592}},
                                0.67338902962844494,
                                0.060943461773639379,
                                0},
                               {{0.0010067010896752274, 0.00076892924835663973, 2.3484565583341927e-05,
                                 0.00062512824970190474, 0.00019001471517819045, 6.5320411959334936e-05}}},
                         Found{ES,
                               {{}, 0.65538332248483344, 0.26576425148596033, 0},
                               {{0.0001455589426619426, 0.0003487499378290648, 0.0012811415609119666,
                                 -0.00042304168138128747, -0.0005540875976002532, 0.0004951563080875244}}}};
  for (const auto& [shape, point, strain] : found) {
    const auto m = material(shape);
    const auto after = simsand::update(m, point, strain);
    EXPECT_GE(int(after.status), int(Status::plastic));
    EXPECT_GT(after.state.plastic_strain, point.plastic_strain);
    EXPECT_LE(yield_of(m, after.state), 1e-9 * mean(after.state.stress));
  }
}

/// Any state and increment leads to an admissible state.
template <class Real> void admissible(int count, Real yield_tolerance) {
  using T = simsand::SymmetricTensor<Real, 6>;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  const auto power = [&](double from, double to) {
    return std::pow(10, from + (to - from) * uniform(random));
  };
  for (int i = 0; i < count; ++i) {
    const Shape& shape = shapes[i % 3];
    const simsand::Material<Real> m({100, Real(0.2), Real(0.51), Real(shape.phi), Real(shape.e_ref),
                                     Real(0.04), Real(0.3), 1, Real(0.0015), Real(3.3), 1, Real(0.6),
                                     Real(p_at), 1});
    const double p = i % 7 == 0 ? 0 : i % 2 ? 1e6 * uniform(random) : power(-3, 6);
    const auto s = random_deviator(random), d = random_deviator(random);
    const double q = (i % 11 == 0 ? 3 : 1) * p * uniform(random), length = power(-8, -1);
    const double volume = i % 5 == 0 ? 0 : length * (2 * uniform(random) - 1);
    simsand::SoilState<Real, 6> old;
    T strain;
    for (int c = 0; c < 6; ++c) {
      old.stress[c] = Real(q * s[c] + (c < 3 ? p : 0));
      strain[c] = Real(length * d[c] + (c < 3 ? volume / 3 : 0));
    }
    old.void_ratio = Real(0.2 + 1.8 * uniform(random));
    old.plastic_strain = Real(i % 13 == 0 ? 0 : power(-6, 0));
    old.separation_strain = Real(i % 17 == 0 ? power(-8, -1) : 0);
    const auto after = simsand::update(m, old, strain);
    ASSERT_GE(int(after.status), 0) << i;
    const Real p1 = simsand::trace(after.state.stress) / 3;
    const auto s1 = simsand::deviator(after.state.stress);
    const Real q1 = simsand::deviatoric_stress(s1);
    ASSERT_TRUE(p1 >= 0 && std::isfinite(p1 + q1 + after.dissipation)) << i;
    ASSERT_TRUE(p1 > 0 || q1 == 0) << i;
    ASSERT_GE(after.dissipation, 0) << i;
    ASSERT_GE(after.state.plastic_strain, old.plastic_strain) << i;
    ASSERT_TRUE(after.state.void_ratio >= Real(0.01) && after.state.void_ratio < 4) << i;
    ASSERT_EQ(after.state.separation_strain > 0, p1 == 0) << i;
    const auto M = simsand::slopes(m, after.state.void_ratio, simsand::pressure_of_mean_stress(m, p1),
                                   simsand::sin_3theta(s1, q1));
    const Real share = simsand::mobilised(m, after.state.plastic_strain);
    ASSERT_LE(simsand::yield_function(q1, p1, M.peak, share), yield_tolerance * p1) << i;
  }
}

TEST(VumatUpdate, AnyStateAndIncrementLeadsToAnAdmissibleState) {
  admissible<double>(100000, 1e-6);
}

// About 30 roundings of single precision, in the invariants of a stress near its isotropic part.
TEST(VumatUpdate, AnyStateAndIncrementLeadsToAnAdmissibleStateInSinglePrecision) {
  admissible<float>(100000, 4e-6f);
}

} // namespace
