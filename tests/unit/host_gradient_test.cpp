// SPDX-License-Identifier: BSD-3-Clause
// The velocity gradient of a disordered cloud with a free surface, against the field it was sampled from.
#include "tests/unit/host_fixture.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace {

using namespace host;
using namespace host_test;

constexpr double slope[4] = {3, -1.5, 0.7, 2}; // 1/s, d v_a / d x_b in [2 a + b]

/// A disc of disordered particles of uneven volumes, well away from the axis, in a linear velocity field.
template <class Geometry> Simulation<Geometry> disc() {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  std::vector<std::array<double, 2>> places;
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j)
      if (i * i + j * j < 110)
        places.push_back({(30 + i + jitter(random)) * spacing, (20 + j + jitter(random)) * spacing});
  auto s = empty_cloud<Geometry>(int(places.size()));
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i) {
    put(p, i, places[i]);
    const auto [x, y] = places[i];
    for (int a = 0; a < 2; ++a) p.velocity[a][i] = 0.4 + slope[2 * a] * x + slope[2 * a + 1] * y;
    p.mass[i] *= 1 + jitter(random);
  }
  arrange(s, spacing, s.kernel.support);
  return s;
}

/// Moment matrix of particle i, from all particles.
template <class Geometry> Eigen::Matrix2d moment(const Simulation<Geometry>& s, int i) {
  const auto& p = s.particles;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int j = 0; j < p.count; ++j) {
    const Eigen::Vector2d x(p.position[0][j] - p.position[0][i], p.position[1][j] - p.position[1][i]);
    const double area = p.mass[j] / (p.density[j] * Geometry::depth * Geometry::weight(p.position[0][j]));
    sum -= area * s.kernel.gradient_factor(x.norm()) * x * x.transpose();
  }
  return sum;
}

template <class Geometry> void expect_exact() {
  auto s = disc<Geometry>();
  const auto& p = s.particles;
  find_gradients(s);
  int on_surface = 0;
  for (int i = 0; i < p.count; ++i) {
    const auto m = moment(s, i);
    const double mean = 0.5 * m.trace(), smallest = mean - std::sqrt(mean * mean - m.determinant());
    ASSERT_GT(smallest, 0.25) << "support of particle " << i;
    on_surface += smallest < 0.6;
    for (int e = 0; e < 4; ++e) EXPECT_NEAR(p.velocity_gradient[e][i], slope[e], 1e-11);
  }
  EXPECT_GT(on_surface, 20);
}

TEST(Gradient, IsExactForALinearFieldUpToTheSurface) {
  expect_exact<PlaneStrain>();
  expect_exact<Axisymmetric>();
}

TEST(Gradient, OfAGrainInFlightIsZero) {
  auto s = empty_cloud<PlaneStrain>(1);
  auto& p = s.particles;
  put(p, 0, {0.1, 0.1});
  p.velocity[0][0] = p.velocity[1][0] = 7;
  arrange(s, spacing, s.kernel.support);
  find_gradients(s);
  for (int e = 0; e < 4; ++e) EXPECT_EQ(p.velocity_gradient[e][0], 0);
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

} // namespace
