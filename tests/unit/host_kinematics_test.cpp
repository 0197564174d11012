// SPDX-License-Identifier: BSD-3-Clause
// Exponential, logarithm, polar decomposition and what is made of them, against closed forms and each other.
#include "host/material/kinematics.hpp"
#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace {

using namespace host;

/// A random tensor of size `size`; in the plane 1-2 with a 33 component if `flat`.
Tensor random_tensor(std::mt19937_64& random, double size, bool flat) {
  std::normal_distribution<double> normal;
  Tensor t;
  for (auto& x : t.reshaped()) x = size * normal(random);
  if (flat) t(0, 2) = t(1, 2) = t(2, 0) = t(2, 1) = 0;
  return t;
}

double distance(const Tensor& a, const Tensor& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// exp(A) by its series, in long double.
Tensor series(const Tensor& a) {
  using Long = Eigen::Matrix<long double, 3, 3>;
  const Long x = a.cast<long double>();
  Long term = Long::Identity(), sum = term;
  for (int n = 1; n < 200; ++n) {
    term = (term * x).eval() / n;
    sum += term;
  }
  return sum.cast<double>();
}

TEST(Kinematics, ExponentialAndLogarithmAreThatOfTheSeries) {
  std::mt19937_64 random(1);
  for (const bool flat : {true, false})
    for (const double size : {1e-9, 1e-4, 1e-2, 0.3, 2.0})
      for (int trial = 0; trial < 50; ++trial) {
        const Tensor a = random_tensor(random, size, flat), e = exponential(a);
        EXPECT_LT(distance(e, series(a)), 2e-14 * e.cwiseAbs().maxCoeff()) << size;
        EXPECT_NEAR(e.determinant(), std::exp(a.trace()),
                    1e-12 * e.cwiseAbs().maxCoeff() * e.norm() * e.norm());
        if (size < 0.5) {
          EXPECT_LT(distance(logarithm(e), a), 1e-13 * (1 + size * 100)) << size;
        }
      }
  EXPECT_THROW(logarithm(-Tensor::Identity()), std::runtime_error);
}

TEST(Kinematics, RotationIsThePolarFactor) {
  std::mt19937_64 random(2);
  for (const bool flat : {true, false})
    for (int trial = 0; trial < 300; ++trial) {
      const Tensor f = exponential(random_tensor(random, 1.0, flat));
      const Tensor r = rotation_of(f), u = r.transpose() * f;
      EXPECT_LT(distance(r.transpose() * r, Tensor::Identity()), 1e-14);
      EXPECT_GT(r.determinant(), 0);
      EXPECT_LT(distance(u, u.transpose()), 1e-13 * f.cwiseAbs().maxCoeff());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Tensor>(u).eigenvalues()[0], 0);
    }
}

TEST(Kinematics, OfSimpleShear) {
  // tan of the angle of R is half the shear; the frame turns by less and less of the spin.
  Tensor f = Tensor::Identity();
  for (const double shear : {0.5, 1.0, 4.0}) {
    const double before = f(0, 1);
    Tensor l = Tensor::Zero();
    l(0, 1) = shear - before;
    const auto m = motion_by_gradient(f, l);
    f = m.gradient_new;
    EXPECT_NEAR(f(0, 1), shear, 1e-14);
    EXPECT_NEAR(m.rotation_new(0, 1), std::sin(std::atan(shear / 2)), 1e-14);
    EXPECT_NEAR(m.spin[2], -(shear - before) / 2 + std::atan(shear / 2) - std::atan(before / 2), 1e-14);
    EXPECT_LT(distance(m.stretch_new * m.stretch_new, f.transpose() * f), 1e-13);
    EXPECT_NEAR(m.strain.trace(), 0, 1e-15);
    const auto led = motion_between(m.gradient_old, m.gradient_new);
    EXPECT_LT(distance(led.strain, m.strain), 1e-14);
  }
}

TEST(Kinematics, ARotationOfEverythingIsNotSeen) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Tensor f = exponential(random_tensor(random, 0.5, false)), l = random_tensor(random, 0.1, false);
    const Tensor w = random_tensor(random, 1.0, false), q = exponential(w - w.transpose());
    const auto m = motion_by_gradient(f, l), turned = motion_by_gradient(q * f, q * l * q.transpose());
    EXPECT_LT(distance(turned.strain, m.strain), 1e-14);
    EXPECT_LT(distance(turned.stretch_new, m.stretch_new), 1e-13);
    EXPECT_LT((turned.spin - m.spin).norm(), 1e-13);
    EXPECT_LT(distance(turned.rotation_new, q * m.rotation_new), 1e-13);
    // A rotation alone: no strain, and the frame turns with it.
    const auto rigid = motion_by_gradient(f, 0.3 * (w - w.transpose()));
    EXPECT_LT(distance(rigid.strain, Tensor::Zero()), 1e-14);
    EXPECT_LT(distance(rigid.stretch_new, rigid.stretch_old), 1e-13);
    if ((w - w.transpose()).norm() < 2) {
      EXPECT_LT(rigid.spin.norm(), 1e-12);
    }
  }
}

TEST(Kinematics, APointWithoutSurroundingsKeepsItsRotation) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Tensor f = exponential(random_tensor(random, 0.5, false)), a = random_tensor(random, 0.02, false);
    const Tensor strain = a + a.transpose();
    const auto m = motion_by_strain(f, strain);
    EXPECT_LT(distance(rotation_of(m.gradient_new), rotation_of(f)), 1e-13);
    EXPECT_NEAR(m.gradient_new.determinant() / f.determinant(), std::exp(strain.trace()), 1e-13);
    // It is what carries F along with the strain and spin that are shown.
    const Tensor r = rotation_of(f);
    const Tensor w{{0, -m.spin[2], m.spin[1]}, {m.spin[2], 0, -m.spin[0]}, {-m.spin[1], m.spin[0], 0}};
    const auto carried = motion_by_gradient(f, r * (strain + w) * r.transpose());
    EXPECT_LT(distance(carried.gradient_new, m.gradient_new), 1e-13);
    EXPECT_LT(distance(carried.strain, strain), 1e-13);
    EXPECT_LT((carried.spin - m.spin).norm(), 1e-13);
  }
}

TEST(Kinematics, ComponentsStandInTheOrderOfAbaqus) {
  const int nine[][2] = {{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 3}, {3, 1}, {2, 1}, {3, 2}, {1, 3}};
  for (int c = 0; c < 9; ++c) EXPECT_EQ(place(c, 3), (std::array{nine[c][0] - 1, nine[c][1] - 1}));
  const int five[][2] = {{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 1}};
  for (int c = 0; c < 5; ++c) EXPECT_EQ(place(c, 1), (std::array{five[c][0] - 1, five[c][1] - 1}));
  std::vector<double> array(18);
  Tensor t;
  t << 11, 12, 13, 21, 22, 23, 31, 32, 33;
  set_general(t, 1, 2, 3, array);
  EXPECT_EQ(array, (std::vector<double>{0, 11, 0, 22, 0, 33, 0, 12, 0, 23, 0, 31, 0, 21, 0, 32, 0, 13}));
  EXPECT_EQ(general_at(array, 1, 2, 3), t);
  EXPECT_EQ(symmetric_at(array, 1, 2, 3)(0, 2), 31);
}

} // namespace
