// SPDX-License-Identifier: BSD-3-Clause
// The mixed control and the call, with materials whose answer is known.
#include "drivers/element/material_point.hpp"
#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace drivers;

namespace {

constexpr double young = 7e6, poisson = 0.3; // Pa, -
constexpr StageScale scale{1e3, young};

/// Isotropic elasticity, tension positive, tensor shear; STATEV(1) counts calls with time, STATEV(2)
/// keeps the stretch U33 it was shown. PROPS(1): Pa added to 11 as a function of strain, for softening.
void elastic(const int* nblock, const int*, const int* nshr, const int* nstatev, const int*, const int*,
             const int*, const double*, const double* total_time, const double*, const char*, const double*,
             const double*, const double*, const double* density, const double* strain, const double*,
             const double*, const double*, const double*, const double*, const double* old,
             const double* state_old, const double* energy_old, const double*, const double*,
             const double* stretch, const double*, const double*, double* stress, double* state,
             double* energy, double*, std::size_t) {
  const int n = *nblock, components = 3 + *nshr;
  const double mu = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson));
  for (int k = 0; k < n; ++k) {
    const double volume = strain[k] + strain[n + k] + strain[2 * n + k];
    energy[k] = energy_old[k];
    for (int c = 0; c < components; ++c) {
      const int i = c * n + k;
      stress[i] = old[i] + 2 * mu * strain[i] + (c < 3 ? (bulk - 2 * mu / 3) * volume : 0);
      energy[k] += (c < 3 ? 1 : 2) * (old[i] + stress[i]) * strain[i] / (2 * density[k]);
    }
    if (*nstatev > 0) state[k] = state_old[k] + (*total_time > 0);
    if (*nstatev > 1) state[n + k] = stretch[2 * n + k];
  }
}

void not_a_number(const int* nblock, const int*, const int* nshr, const int*, const int*, const int*,
                  const int*, const double*, const double*, const double*, const char*, const double*,
                  const double*, const double*, const double*, const double*, const double*, const double*,
                  const double*, const double*, const double*, const double*, const double*, const double*,
                  const double*, const double*, const double*, const double*, const double*, double* stress,
                  double*, double*, double*, std::size_t) {
  std::fill_n(stress, *nblock * (3 + *nshr), std::numeric_limits<double>::quiet_NaN());
}

host::Material made_of(vumat::Subroutine<double>* call) {
  return {{"test", nullptr, call}, "TEST", {}, 2};
}

PointState start() {
  PointState p;
  p.stress << 3e3, 2e3, 1e3, 100, 200, 300;
  p.state = {0, 0};
  p.initial_density = 1500;
  return p;
}

/// Conditions on single components: stress where `on_stress`, otherwise strain.
MixedControl per_component(const PointState& from, std::array<bool, 6> on_stress, const Vector6& change) {
  MixedControl c;
  for (int i = 0; i < 6; ++i) {
    (on_stress[i] ? c.stress : c.strain)(i, i) = 1;
    c.at_start[i] = on_stress[i] ? from.stress[i] : from.strain[i];
  }
  c.change = change;
  return c;
}

TEST(MaterialPoint, InvariantsOfKnownTensors) {
  Vector6 compression, shear;
  compression << 3, 1, 1, 0, 0, 0;
  shear << 0, 0, 0, 0, 1, 0;
  EXPECT_NEAR(mean_stress(compression), 5.0 / 3, 1e-15);
  EXPECT_NEAR(deviatoric_stress(compression), 2, 1e-15);
  EXPECT_NEAR(lode_angle(compression), -30, 1e-6);
  EXPECT_NEAR(lode_angle(-compression), 30, 1e-6);
  EXPECT_NEAR(deviatoric_stress(shear), std::sqrt(3), 1e-15);
  EXPECT_NEAR(lode_angle(shear), 0, 1e-12);
  EXPECT_EQ(lode_angle(Vector6::Zero()), 0);
  EXPECT_NEAR(deviatoric_strain(compression), 4.0 / 3, 1e-15);
}

TEST(MaterialPoint, ABlockOfManyIsManyBlocksOfOne) {
  MaterialCaller material(made_of(elastic));
  std::vector<PointState> from(300, start());
  std::vector<Vector6> increments;
  for (int k = 0; k < 300; ++k) {
    from[k].stress *= 1 + 0.01 * k;
    from[k].strain[2] = 0.001 * k;
    increments.push_back(1e-4 * (k + 1) * Vector6(1, -2, 3, -4, 5, -6));
  }
  const auto many = material.respond(from, increments, 1);
  for (int k = 0; k < 300; ++k) {
    const auto one = material.respond({&from[k], 1}, {&increments[k], 1}, 1).front();
    EXPECT_EQ(many[k].stress, one.stress);
    EXPECT_EQ(many[k].state, one.state);
    EXPECT_EQ(many[k].internal_energy, one.internal_energy);
    EXPECT_EQ(many[k].strain, one.strain);
  }
}

TEST(MaterialPoint, StretchIsTheExponentialOfTheStrain) {
  auto shown = made_of(elastic);
  shown.frame = host::Frame::green_naghdi;
  MaterialCaller material(shown);
  const Vector6 coaxial(0.1, 0.2, 0.3, 0, 0, 0);
  const auto from = start();
  EXPECT_DOUBLE_EQ(material.respond({&from, 1}, {&coaxial, 1}, 1).front().state[1], std::exp(-0.3));
  // Pure shear in 2-3: U33 = cosh.
  const Vector6 shear(0, 0, 0, 0, 0.4, 0);
  EXPECT_NEAR(material.respond({&from, 1}, {&shear, 1}, 1).front().state[1], std::cosh(0.4), 1e-14);
}

TEST(MaterialPoint, MixedControlOfElasticityIsExact) {
  MaterialCaller material(made_of(elastic));
  auto point = start();
  const auto from = point;
  // Uniaxial stress: strain 11 given, the other stresses held.
  const auto control = per_component(from, {false, true, true, true, true, true}, 1e-3 * Vector6::Unit(0));
  auto stiffness = material.elastic_stiffness(point);
  const auto report = advance(material, control, 0, 1, 1, scale, {}, point, stiffness);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 2);
  EXPECT_NEAR(point.stress[0] - from.stress[0], 1e-3 * young, 1e-3);
  for (int c = 1; c < 6; ++c) EXPECT_NEAR(point.stress[c], from.stress[c], 1e-4);
  EXPECT_NEAR(point.strain[1], -1e-3 * poisson, 1e-12);
  EXPECT_EQ(point.state[0], 1);                                             // one accepted increment
  const double work = 0.5 * (from.stress + point.stress).dot(point.strain); // coaxial: no shear strain
  EXPECT_NEAR(point.internal_energy * 1500, work, 1e-3 * work);
}

TEST(MaterialPoint, ARestrictionMayMixStressAndStrain) {
  MaterialCaller material(made_of(elastic));
  auto point = start();
  const auto from = point;
  auto control = per_component(from, {false, true, true, true, true, true}, 1e-3 * Vector6::Unit(0));
  constexpr double spring = 2e6; // Pa: d sigma_22 + spring d eps_22 = 0
  control.strain(1, 1) = spring;
  auto stiffness = material.elastic_stiffness(point);
  ASSERT_TRUE(advance(material, control, 0, 1, 1, scale, {}, point, stiffness).converged);
  const Vector6 ds = point.stress - from.stress;
  EXPECT_NEAR(ds[1], -spring * point.strain[1], 1e-3);
  EXPECT_NEAR(point.strain[1], (ds[1] - poisson * ds[0]) / young, 1e-10);
}

TEST(MaterialPoint, TheDataCheckGivesTheStiffness) {
  MaterialCaller material(made_of(elastic));
  const auto stiffness = material.elastic_stiffness(start());
  EXPECT_NEAR(stiffness(0, 0), young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)), 1);
  EXPECT_NEAR(stiffness(3, 3), young / (1 + poisson), 1); // tensor shear: 2 G
  EXPECT_NEAR(stiffness(0, 4), 0, 1);
}

TEST(MaterialPoint, AnIncrementAtRestLeavesTheStiffnessAsItIs) {
  MaterialCaller material(made_of(elastic));
  auto point = start();
  const auto from = point;
  const auto control = per_component(from, {false, true, true, true, true, true}, Vector6::Zero());
  auto stiffness = material.elastic_stiffness(point);
  const auto before = stiffness;
  ASSERT_TRUE(advance(material, control, 0, 1, 1, scale, {}, point, stiffness).converged);
  EXPECT_EQ(stiffness, before);
  EXPECT_EQ(point.stress, from.stress);
}

TEST(MaterialPoint, DependentRestrictionsFailAndSaySo) {
  MaterialCaller material(made_of(elastic));
  auto point = start();
  auto control = per_component(point, {false, true, true, true, true, true}, 1e-3 * Vector6::Unit(0));
  control.stress(1, 1) = 0; // nothing is asked of 22
  auto stiffness = material.elastic_stiffness(point);
  const auto report = advance(material, control, 0, 1, 1, scale, {}, point, stiffness);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(point.strain, Vector6::Zero().eval());
}

TEST(MaterialPoint, ACommittedStateSurvivesAMaterialThatReturnsNaN) {
  MaterialCaller material(made_of(not_a_number));
  auto point = start();
  const auto control =
      per_component(point, {false, false, false, false, false, false}, Vector6::Ones() * 1e-3);
  Matrix6 stiffness = young * Matrix6::Identity();
  const auto report = advance(material, control, 0, 1, 1, scale, {}, point, stiffness);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.finite);
  EXPECT_EQ(report.cuts, NewtonOptions{}.max_cuts);
  EXPECT_EQ(point.stress, start().stress);
}

} // namespace
