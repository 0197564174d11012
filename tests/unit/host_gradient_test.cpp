// SPDX-License-Identifier: BSD-3-Clause
// The velocity gradient of a disordered cloud with a free surface, against the field it was sampled from.
#include "host/geometry.hpp"
#include "host/gradient.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace host;

constexpr double spacing = 0.002; // m
const Kernel<2> kernel(1.5 * spacing);
constexpr double slope[4] = {3, -1.5, 0.7, 2}; // 1/s, d v_a / d x_b in [2 a + b]

/// A disc of disordered particles of uneven volumes, well away from the axis, in a linear velocity field.
template <class Geometry> Particles<Geometry> disc() {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  std::vector<std::array<double, 2>> places;
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j)
      if (i * i + j * j < 110)
        places.push_back({(30 + i + jitter(random)) * spacing, (20 + j + jitter(random)) * spacing});
  Particles<Geometry> p;
  p.resize(int(places.size()), 0);
  for (int i = 0; i < p.count; ++i) {
    const auto [x, y] = places[i];
    p.id[i] = i;
    p.position[0][i] = x;
    p.position[1][i] = y;
    for (int a = 0; a < 2; ++a) p.velocity[a][i] = 0.4 + slope[2 * a] * x + slope[2 * a + 1] * y;
    p.density[i] = 1500;
    p.mass[i] = 1500 * spacing * spacing * Geometry::depth * Geometry::weight(x) * (1 + jitter(random));
  }
  return p;
}

template <class Geometry> void find_gradient(Particles<Geometry>& p) {
  Records<Geometry> records;
  NeighbourLists lists;
  records.motion.resize(p.padded());
  const Images none{{}, p.padded(), p.padded()};
  sort_particles(p, spacing);
  show_motion(p, records);
  find_neighbours(p, none, records, kernel.support, lists);
  update_gradient(p, kernel, lists, records);
}

/// Moment matrix of particle i, from all particles.
template <class Geometry> Eigen::Matrix2d moment(const Particles<Geometry>& p, int i) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int j = 0; j < p.count; ++j) {
    const Eigen::Vector2d x(p.position[0][j] - p.position[0][i], p.position[1][j] - p.position[1][i]);
    const double area = p.mass[j] / (p.density[j] * Geometry::depth * Geometry::weight(p.position[0][j]));
    sum -= area * kernel.gradient_factor(x.norm()) * x * x.transpose();
  }
  return sum;
}

template <class Geometry> void expect_exact() {
  auto p = disc<Geometry>();
  find_gradient(p);
  int on_surface = 0;
  for (int i = 0; i < p.count; ++i) {
    const auto m = moment(p, i);
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
  Particles<PlaneStrain> p;
  p.resize(1, 0);
  p.position[0][0] = p.position[1][0] = 0.1;
  p.velocity[0][0] = p.velocity[1][0] = 7;
  p.density[0] = p.mass[0] = 1;
  find_gradient(p);
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
