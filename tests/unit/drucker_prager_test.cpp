// SPDX-License-Identifier: BSD-3-Clause
// The Drucker-Prager VUMAT against closed forms, through the interface and the element driver's mixed control.
#include "drivers/element/material_point.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace drivers;

namespace {

constexpr double young = 2e6, poisson = 0.2, bulk = young / (3 * (1 - 2 * poisson)),
                 shear = young / (2 * (1 + poisson));
constexpr double radians = std::numbers::pi / 180;

double compression_cone(double angle) {
  return 6 * std::sin(angle * radians) / (3 - std::sin(angle * radians));
}

host::Material material(double friction, double dilation, double cone = 0) {
  return {host::load_vumat(std::string(SIMSAND_BINARY_DIR) + "/libdrucker_prager_vumat.so"),
          "DRUCKER_PRAGER",
          {young, poisson, friction, dilation, cone},
          3};
}

PointState under(double pressure) {
  PointState p;
  p.stress << pressure, pressure, pressure, 0, 0, 0;
  p.state = {0, 0, 0};
  p.initial_density = 1600;
  return p;
}

Vector6 strain(double s11, double s22, double s33, double s12 = 0) {
  Vector6 e;
  e << s11, s22, s33, s12, 0, 0;
  return e;
}

PointState after(MaterialCaller& caller, const PointState& from, const Vector6& increment) {
  return caller.respond(std::span(&from, 1), std::span(&increment, 1), 1e-3).front();
}

/// Drained triaxial compression to `axial`, lateral stress held.
PointState compressed(MaterialCaller& caller, double cell_pressure, double axial) {
  MixedControl control;
  for (int c = 0; c < 6; ++c) (c == 0 ? control.strain : control.stress)(c, c) = 1;
  auto point = under(cell_pressure);
  control.at_start = point.stress;
  control.at_start[0] = 0;
  control.change[0] = axial;
  Matrix6 stiffness = caller.elastic_stiffness(point);
  const int steps = 100;
  for (int i = 0; i < steps; ++i) {
    const auto report = advance(caller, control, double(i) / steps, double(i + 1) / steps, 1,
                                scale_of(point.stress, stiffness), {}, point, stiffness);
    EXPECT_TRUE(report.converged);
  }
  return point;
}

} // namespace

TEST(DruckerPrager, TriaxialStrengthIsMohrCoulombs) {
  for (double friction : {18.5, 24.0, 40.0}) {
    MaterialCaller caller(material(friction, 0), 2);
    const auto point = compressed(caller, 1e3, 0.02);
    const double sine = std::sin(friction * radians);
    EXPECT_NEAR(point.stress[0] / point.stress[1], (1 + sine) / (1 - sine), 1e-6);
    EXPECT_EQ(point.state[2], 1);
  }
}

TEST(DruckerPrager, DilatesByItsAngle) {
  for (double dilation : {0.0, 10.0, 30.0}) {
    MaterialCaller caller(material(30, dilation), 2);
    const auto a = compressed(caller, 1e3, 0.01), b = compressed(caller, 1e3, 0.02);
    // Stress is constant, so all strain between is plastic.
    const Vector6 flow = b.strain - a.strain;
    EXPECT_NEAR(volumetric_strain(flow) / deviatoric_strain(flow), -compression_cone(dilation), 1e-5);
  }
}

TEST(DruckerPrager, PlaneStrainConeMeetsMohrCoulombAtConstantVolume) {
  // Without dilation the out-of-plane stress drifts to the mean of the others, where the in-plane strength is
  // sin phi = (s1 - s3) / (s1 + s3) = M / sqrt(3) for the mean pressure: the cone of Bui et al. gives the tangent form.
  const double friction = 21.9, tangent = std::tan(friction * radians);
  MaterialCaller caller(material(friction, 0, 1), 2);
  auto point = under(1e3);
  for (int i = 0; i < 4000; ++i) point = after(caller, point, strain(2e-5, -2e-5, 0));
  const double in_plane = (point.stress[0] - point.stress[1]) / (point.stress[0] + point.stress[1]);
  EXPECT_NEAR(point.stress[2], (point.stress[0] + point.stress[1]) / 2, 1e-3);
  EXPECT_NEAR(in_plane, 3 * tangent / std::sqrt(9 + 12 * tangent * tangent), 1e-6);
}

TEST(DruckerPrager, ElasticInsideTheCone) {
  MaterialCaller caller(material(30, 10), 2);
  const Vector6 e = strain(2e-4, 1e-4, -5e-5, 3e-5);
  const auto point = after(caller, under(1e3), e);
  const double volume = volumetric_strain(e);
  for (int c = 0; c < 6; ++c)
    EXPECT_NEAR(point.stress[c], (c < 3 ? 1e3 + (bulk - 2 * shear / 3) * volume : 0) + 2 * shear * e[c],
                1e-7);
  EXPECT_EQ(point.state[2], 0);
  const double density =
      point.initial_density * std::exp(0.5 * volume); // energies are per mass, in the middle of the step
  EXPECT_NEAR(point.internal_energy * density,
              0.5 * (under(1e3).stress + point.stress).head<3>().dot(e.head<3>()) + point.stress[3] * e[3],
              1e-9);
}

TEST(DruckerPrager, OpenedGapMustCloseBeforeStressReturns) {
  MaterialCaller caller(material(30, 0), 2);
  const auto start = under(1e3);
  const auto open = after(caller, start, strain(-0.01, 0, 0));
  EXPECT_EQ(open.stress.norm(), 0);
  EXPECT_EQ(open.state[2], 2);
  EXPECT_NEAR(open.state[0], 0.01 - 1e3 / bulk, 1e-12);
  const auto closing = after(caller, open, strain(0.005, 0, 0));
  EXPECT_EQ(closing.stress.norm(), 0);
  const auto closed = after(caller, closing, strain(0.005, 0, 0));
  EXPECT_NEAR(mean_stress(closed.stress), 1e3, 1e-6 * 1e3);
  EXPECT_EQ(closed.state[0], 0);
}

TEST(DruckerPrager, RandomIncrementsStayOnOrInsideTheConeAndAddNoEnergy) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const double strength = compression_cone(35);
  MaterialCaller caller(material(35, 15), 2);
  auto point = under(1e3);
  int plastic = 0;
  for (int i = 0; i < 20000; ++i) {
    Vector6 e;
    for (int c = 0; c < 6; ++c) e[c] = 3e-4 * normal(random);
    const auto next = after(caller, point, e);
    ASSERT_LE(deviatoric_stress(next.stress), strength * mean_stress(next.stress) * (1 + 1e-10) + 1e-9);
    ASSERT_GE(mean_stress(next.stress), 0);
    ASSERT_GE(next.inelastic_energy, point.inelastic_energy);
    plastic += next.state[2] == 1;
    point = next;
    if (mean_stress(point.stress) > 1e5 || point.state[0] > 0.1) point = under(1e3);
  }
  EXPECT_GT(plastic, 1000);
}

TEST(DruckerPrager, RefusesPropertiesByNumber) {
  auto bad = material(30, 40); // dilates by more than its friction
  MaterialCaller caller(bad, 2);
  EXPECT_EQ(after(caller, under(1e3), strain(1e-5, 0, 0)).state[2], -104);
  bad.properties = {young};
  MaterialCaller too_few(bad, 2);
  EXPECT_EQ(after(too_few, under(1e3), strain(1e-5, 0, 0)).state[2], -102);
}
