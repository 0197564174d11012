// SPDX-License-Identifier: BSD-3-Clause
// The velocity gradient of a disordered cloud with a free surface, against the field it was sampled from.
#include "tests/unit/host_fixture.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace {

using namespace host;
using namespace host_test;

constexpr double slopes[9] = {3, -1.5, 0.7, 2, 0.4, -2.2, 1.1, -0.6, 1.7}; // 1/s, any

/// d v_a / d x_b of the field.
template <class Geometry> double slope(int a, int b) {
  return slopes[Geometry::dimension * a + b];
}

/// A disc or ball of disordered particles of uneven volumes, well away from the axis, in a linear velocity field.
template <class Geometry> Simulation<Geometry> ball() {
  constexpr int D = Geometry::dimension, radius = D == 2 ? 12 : 8;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  std::vector<Place<Geometry>> places;
  constexpr int across = 2 * radius + 1;
  for (int n = 0; n < (D == 2 ? across * across : across * across * across); ++n) {
    const int index[3] = {n % across - radius, n / across % across - radius, n / across / across - radius};
    int square = 0;
    for (int a = 0; a < D; ++a) square += index[a] * index[a];
    if (square >= (radius - 1.5) * (radius - 1.5)) continue;
    Place<Geometry> place;
    for (int a = 0; a < D; ++a) place[a] = (30 - 10 * a + index[a] + jitter(random)) * spacing;
    places.push_back(place);
  }
  auto s = empty_cloud<Geometry>(int(places.size()));
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i) {
    put(p, i, places[i]);
    for (int a = 0; a < D; ++a) {
      p.velocity[a][i] = 0.4;
      for (int b = 0; b < D; ++b) p.velocity[a][i] += slope<Geometry>(a, b) * places[i][b];
    }
    p.mass[i] *= 1 + jitter(random);
  }
  arrange(s, spacing, s.kernel.support);
  return s;
}

template <class Geometry> using Matrix = Eigen::Matrix<double, Geometry::dimension, Geometry::dimension>;

/// Moment matrix of particle i, from all particles.
template <class Geometry> Matrix<Geometry> moment(const Simulation<Geometry>& s, int i) {
  const auto& p = s.particles;
  Matrix<Geometry> sum = Matrix<Geometry>::Zero();
  for (int j = 0; j < p.count; ++j) {
    Eigen::Matrix<double, Geometry::dimension, 1> x;
    for (int a = 0; a < Geometry::dimension; ++a) x[a] = p.position[a][j] - p.position[a][i];
    const double area = p.mass[j] / (p.density[j] * Geometry::depth * Geometry::weight(p.position[0][j]));
    sum -= area * s.kernel.gradient_factor(x.norm()) * x * x.transpose();
  }
  return sum;
}

template <class Geometry> void expect_exact() {
  constexpr int D = Geometry::dimension;
  auto s = ball<Geometry>();
  const auto& p = s.particles;
  const auto stages = find_gradients(s);
  int on_surface = 0;
  for (int i = 0; i < p.count; ++i) {
    Eigen::SelfAdjointEigenSolver<Matrix<Geometry>> solver;
    const double smallest =
        solver.computeDirect(moment(s, i), Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
    ASSERT_GT(smallest, least_support) << "support of particle " << i;
    on_surface += smallest < 0.6;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b)
        EXPECT_NEAR(stages.velocity_gradient[D * a + b][i], slope<Geometry>(a, b), 1e-11);
  }
  EXPECT_GT(on_surface, 20);
}

TEST(Gradient, IsExactForALinearFieldUpToTheSurface) {
  expect_exact<PlaneStrain>();
  expect_exact<Axisymmetric>();
  expect_exact<ThreeDimensional>();
}

TEST(Gradient, OfAGrainInFlightIsZero) {
  auto s = empty_cloud<PlaneStrain>(1);
  auto& p = s.particles;
  put(p, 0, {0.1, 0.1});
  p.velocity[0][0] = p.velocity[1][0] = 7;
  arrange(s, spacing, s.kernel.support);
  const auto stages = find_gradients(s);
  for (int e = 0; e < 4; ++e) EXPECT_EQ(stages.velocity_gradient[e][0], 0);
}

TEST(Gradient, InverseOfTheMomentIsShiftedWhereSupportIsMissing) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> eigenvalue(0, 1.2), angle(0, 3.2);
  int shifted = 0;
  for (int k = 0; k < 200; ++k) {
    const double small = std::min(eigenvalue(random), 1.0), large = small + eigenvalue(random);
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle(random)).toRotationMatrix();
    const Eigen::Matrix2d m = turn * Eigen::Vector2d(small, large).asDiagonal() * turn.transpose();
    const double upper[3] = {m(0, 0), m(0, 1), m(1, 1)};
    double inverse[4];
    invert_moment(upper, inverse);
    const double shift = std::max(0.25 - small, 0.0);
    shifted += shift > 0;
    const Eigen::Matrix2d expected = (m + shift * Eigen::Matrix2d::Identity()).inverse();
    for (int e = 0; e < 4; ++e) EXPECT_NEAR(inverse[e], expected(e / 2, e % 2), 1e-12);
  }
  EXPECT_GT(shifted, 20);
  const double nothing[3] = {};
  double inverse[4];
  invert_moment(nothing, inverse);
  EXPECT_EQ(inverse[0], 4);
  EXPECT_EQ(inverse[1], 0);
}

/// Upper triangle of a random matrix with the eigenvalues `values`.
Eigen::Matrix3d with_eigenvalues(const Eigen::Vector3d& values, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond any(normal(random), normal(random), normal(random), normal(random));
  const Eigen::Matrix3d turn = any.normalized().toRotationMatrix();
  return turn * values.asDiagonal() * turn.transpose();
}

void expect_shifted_inverse(const Eigen::Matrix3d& m, double smallest) {
  const double upper[6] = {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
  double inverse[9];
  invert_moment(upper, inverse);
  // Where two eigenvalues are equal, the closed form of the smallest has half the digits.
  const double tolerance = smallest < least_support ? 1e-6 : 1e-12;
  const double shift = std::max(least_support - smallest, 0.0);
  const Eigen::Matrix3d expected = (m + shift * Eigen::Matrix3d::Identity()).inverse();
  for (int e = 0; e < 9; ++e) EXPECT_NEAR(inverse[e], expected(e / 3, e % 3), tolerance);
  Lane upper_lanes[6], inverse_lanes[9];
  for (int e = 0; e < 6; ++e) upper_lanes[e] = upper[e] - Lane{};
  invert_moment(upper_lanes, inverse_lanes);
  for (int e = 0; e < 9; ++e) EXPECT_NEAR(inverse_lanes[e][5], inverse[e], tolerance);
}

TEST(Gradient, InverseOfTheMomentInThreeDimensions) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> eigenvalue(0, 1.2);
  int shifted = 0;
  for (int k = 0; k < 300; ++k) {
    Eigen::Vector3d values(eigenvalue(random), eigenvalue(random), eigenvalue(random));
    if (k % 3 == 1) values[1] = values[0]; // alone, in a row, in a layer: equal eigenvalues
    if (k % 3 == 2) values[1] = values[2] = 0;
    shifted += values.minCoeff() < least_support;
    expect_shifted_inverse(with_eigenvalues(values, random), values.minCoeff());
  }
  EXPECT_GT(shifted, 100);
  expect_shifted_inverse(Eigen::Matrix3d::Zero(), 0);
  expect_shifted_inverse(Eigen::Matrix3d::Identity(), 1);
}

} // namespace
