// SPDX-License-Identifier: BSD-3-Clause
// The functions of the model against what they abbreviate.
#include "tests/unit/vumat_fixture.hpp"
#include <gtest/gtest.h>

namespace {

using namespace vumat_test;
using namespace simsand;

constexpr double degree = 0.017453292519943295;

TEST(VumatFunctions, DeterminantAndContractionAgreeWithTheFullMatrix) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Tensor6 a;
  for (int c = 0; c < 6; ++c) a[c] = normal(random);
  const double m[3][3] = {{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}};
  double det = 0, squares = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    det += m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
    for (int l = 0; l < 3; ++l) squares += m[i][l] * m[i][l];
  }
  EXPECT_NEAR(determinant(a), det, 1e-14);
  EXPECT_NEAR(contract(a, a), squares, 1e-13);

  SymmetricTensor<double, 4> b{{a[0], a[1], a[2], a[3]}};
  Tensor6 c{{a[0], a[1], a[2], a[3], 0, 0}};
  EXPECT_NEAR(determinant(b), determinant(c), 1e-14);
  EXPECT_NEAR(contract(b, b), contract(c, c), 1e-14);
}

TEST(VumatFunctions, LodeAngleOfCompressionExtensionAndShear) {
  const Tensor6 compression{{2. / 3, -1. / 3, -1. / 3}}, shear{{0, 0, 0, 1. / std::sqrt(3.)}};
  EXPECT_NEAR(deviatoric_stress(compression), 1, 1e-15);
  EXPECT_NEAR(sin_3theta(compression, 1.), -1, 1e-14);
  EXPECT_NEAR(sin_3theta(scale(-1., compression), 1.), 1, 1e-14);
  EXPECT_NEAR(deviatoric_stress(shear), 1, 1e-15);
  EXPECT_EQ(sin_3theta(shear, 1.), 0);
  EXPECT_EQ(sin_3theta(Tensor6{}, 0.), 0);
}

TEST(VumatFunctions, SlopeIsThePublishedProductOfCompressionSlopeAndLodeFactor) {
  for (double angle = 2; angle < 89; angle += 3) {
    const double sine = std::sin(angle * degree), c = (3 - sine) / (3 + sine), c4 = std::pow(c, 4);
    const double compression = 6 * sine / (3 - sine);
    const auto at = [&](double s) { return slope(std::tan(angle * degree), s); };
    EXPECT_NEAR(at(-1).value, compression, 1e-13 * compression);
    EXPECT_NEAR(at(1).value, c * compression, 1e-13 * compression);
    for (double s = -1; s <= 1; s += 0.125)
      EXPECT_NEAR(at(s).value, compression * std::pow(2 * c4 / (1 + c4 + (1 - c4) * s), 0.25),
                  1e-13 * compression);
    EXPECT_EQ(at(0).convex, c >= 0.611) << angle;
  }
}

TEST(VumatFunctions, FrictionFollowsDensityAndEndsAtTheCriticalAngle) {
  for (const auto& shape : shapes) {
    const auto m = material(shape);
    const auto p = pressure_of_mean_stress(m, 2000.);
    const double e_c = shape.e_ref - 0.04 * std::pow(2000 / p_at, 0.3);
    EXPECT_NEAR(critical_void_ratio(m, p.log_ratio), e_c, 1e-14);
    const double sine = std::sin(shape.phi * degree);
    const auto critical = slopes(m, e_c, p, -1.);
    EXPECT_NEAR(critical.peak, 6 * sine / (3 - sine), 1e-13);
    EXPECT_NEAR(critical.transformation, critical.peak, 1e-13);
    const double t = std::tan(shape.phi * degree), ratio = e_c / 0.5;
    const auto dense = slopes(m, 0.5, p, -1.);
    EXPECT_NEAR(dense.peak, slope(std::pow(ratio, 3.3) * t, -1.).value, 1e-13);
    EXPECT_NEAR(dense.transformation, slope(t / ratio, -1.).value, 1e-13);
  }
}

TEST(VumatFunctions, SlopesStayFiniteForAnyDensity) {
  auto given = parameters_of(SS, 0.6);
  given.n_p = given.n_d = 20;
  const Material<double> m(given);
  const Material<float> f({100, 0.2f, 0.51f, 60, 2, 0, 0.3f, 1, 0.0015f, 20, 20, 0.6f, 101325, 1});
  for (double e = 0.01; e < 20; e *= 1.2) {
    const auto M = slopes(m, e, pressure_of_mean_stress(m, 1e3), 1.);
    EXPECT_TRUE(M.peak > 0 && M.peak <= 3 && M.transformation > 0 && M.transformation <= 3) << e;
    const auto F = slopes(f, float(e), pressure_of_mean_stress(f, 1e3f), -1.f);
    EXPECT_TRUE(F.peak > 0 && F.peak <= 3.001f && F.transformation > 0 && F.transformation <= 3.001f) << e;
  }
}

TEST(VumatFunctions, MeasureAndMeanStressAreInverseAndDifferByTheBulkModulus) {
  const auto m = material(SS);
  for (double p = 1e-3; p < 1e7; p *= 3.7) {
    const auto a = pressure_of_mean_stress(m, p), b = pressure_of_measure(m, a.measure);
    EXPECT_NEAR(b.mean_stress, p, 1e-12 * p);
    EXPECT_NEAR(b.stiffness, a.stiffness, 1e-12 * a.stiffness);
    EXPECT_NEAR(a.stiffness, std::pow(std::max(p, 1e-5 * p_at) / p_at, 0.51), 1e-12 * a.stiffness);
    const double d = 1e-5 * a.measure;
    const double dp =
        pressure_of_measure(m, a.measure + d).mean_stress - pressure_of_measure(m, a.measure - d).mean_stress;
    EXPECT_NEAR(dp / (2 * d), p_at * a.stiffness, 1e-6 * p_at * a.stiffness);
  }
  EXPECT_EQ(pressure_of_mean_stress(m, 0.).measure, 0);
  EXPECT_EQ(pressure_of_measure(m, 0.).mean_stress, 0);
}

TEST(VumatFunctions, VoidRatioFollowsTheExponentialAndReturns) {
  for (const double strain : {1e-8, 1e-3, 0.1, -0.1, 0.3, -0.3}) {
    const double e = void_ratio_after(0.6, strain);
    const double change = 1.6 * std::expm1(-strain);
    EXPECT_NEAR(e, 0.6 + change, std::abs(change) * std::pow(strain, 8) / 1e6 + 3e-16);
    EXPECT_NEAR(void_ratio_after(e, -strain), 0.6, 3e-16);
  }
  // Beyond the series.
  for (const double strain : {-0.35, -3., -20.})
    EXPECT_NEAR(void_ratio_after(0.6, strain), 0.6 + 1.6 * std::expm1(-strain), 1e-15 * std::exp(-strain));
  EXPECT_EQ(void_ratio_after(0.6, 50.), 0.01);
}

TEST(VumatFunctions, MeanFactorIsTheIntegralOverTheStrain) {
  for (const double strain : {1e-6, 0.01, -0.2}) {
    constexpr int n = 2000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += void_ratio_factor(0.6 + 1.6 * std::expm1(-strain * (i + 0.5) / n)) / n;
    const double e_middle = 0.6 + 1.6 * std::expm1(-strain / 2);
    EXPECT_NEAR(mean_void_ratio_factor(e_middle, strain), sum, 1e-7 * sum);
  }
}

TEST(VumatFunctions, MeanMobilisedIsTheIntegralOfTheShare) {
  const auto m = material(SS);
  for (const double start : {0., 5e-4, 1e-2})
    for (const double x : {1e-7, 5e-4, 1.5e-3}) {
      constexpr int n = 1000;
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += mobilised(m, start + x * (i + 0.5) / n) / n;
      EXPECT_NEAR(1 - mean_mobilised(m, 1 / (m.given.k_p + start), x), 1 - sum, 1.3e-3 * (1 - sum));
    }
}

TEST(VumatFunctions, SmallIsotropicAndShearStrainsSeeTheModuli) {
  const auto m = material(SS);
  std::mt19937_64 random(3);
  for (const double p : {50., 2e3, 2e5}) {
    const double K = 100 * p_at * std::pow(2.97 - 0.6, 2) / 1.6 * std::pow(p / p_at, 0.51); // (1)
    const double G = 3 * K * (1 - 2 * 0.2) / (2 * (1 + 0.2));                               // (2)
    const State6 old{isotropic(p), 0.6, 0.1, 0};
    const auto s = random_deviator(random);
    const double dv = 1e-7;
    const double dp = mean(update(m, old, isotropic(dv / 3)).state.stress) -
                      mean(update(m, old, isotropic(-dv / 3)).state.stress);
    EXPECT_NEAR(dp / (2 * dv), K, 1e-5 * K);
    const auto sheared = update(m, old, scale(dv, s));
    EXPECT_EQ(sheared.status, Status::elastic);
    EXPECT_NEAR(q_of(sheared.state.stress) / (2 * dv), G, 1e-6 * G);
    const auto linear = elastic_stress(m, old, add_mean(scale(dv, s), dv / 3));
    EXPECT_NEAR(mean(linear) - p, K * dv, 1e-9 * K * dv + 1e-15 * p);
    EXPECT_NEAR(q_of(linear), 2 * G * dv, 1e-9 * G * dv);
  }
}

} // namespace
