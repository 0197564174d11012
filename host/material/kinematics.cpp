// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/kinematics.hpp"
#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace host {
namespace {

double size_of(const Tensor& a) {
  return a.cwiseAbs().maxCoeff();
}

Tensor symmetric_part(const Tensor& a) {
  return 0.5 * (a + a.transpose());
}

/// Axial vector of the skew part: components 32, 13, 21.
Eigen::Vector3d axial(const Tensor& a) {
  return 0.5 * Eigen::Vector3d(a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1));
}

Tensor skew(const Eigen::Vector3d& w) {
  return Tensor{{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
}

/// Rotation vector of a rotation by less than half a turn.
Eigen::Vector3d rotation_vector(const Tensor& rotation) {
  const Eigen::Vector3d w = axial(rotation); // its length is the sine of the angle
  const double sine = w.norm();
  return sine < 1e-8 ? w : Eigen::Vector3d(w / sine * std::atan2(sine, 0.5 * (rotation.trace() - 1)));
}

bool in_plane(const Tensor& a) {
  return a(0, 2) == 0 && a(1, 2) == 0 && a(2, 0) == 0 && a(2, 1) == 0;
}

/// Strain, spin and the two polar decompositions of a motion whose F and L dt are known.
Kinematics decomposed(const Tensor& gradient_old, const Tensor& gradient_new, const Tensor& velocity_dt) {
  Kinematics m{
      gradient_old, gradient_new, rotation_of(gradient_old), rotation_of(gradient_new), {}, {}, {}, {}};
  m.stretch_old = symmetric_part(m.rotation_old.transpose() * gradient_old);
  m.stretch_new = symmetric_part(m.rotation_new.transpose() * gradient_new);
  const Tensor half_way = rotation_of(m.rotation_old + m.rotation_new);
  m.strain = half_way.transpose() * symmetric_part(velocity_dt) * half_way;
  const Eigen::Vector3d turned = rotation_vector(m.rotation_new * m.rotation_old.transpose());
  m.spin = half_way.transpose() * (axial(velocity_dt) - turned);
  return m;
}

} // namespace

Tensor exponential(const Tensor& a) {
  if (in_plane(a) && a(0, 1) == 0 && a(1, 0) == 0) return a.diagonal().array().exp().matrix().asDiagonal();
  // Pade approximations of orders (3, 3) and (6, 6), errors of order x^7 / 1e5 and x^13 / 1e13.
  const double size = size_of(a);
  int halvings = 0;
  while (std::ldexp(size, -halvings) > 0.3 && halvings < 60) ++halvings;
  const Tensor x = std::ldexp(1.0, -halvings) * a, x2 = x * x;
  Tensor even = Tensor::Identity(), odd = 0.5 * x;
  if (size <= 0.01) {
    even += x2 / 10;
    odd += x * x2 / 120;
  } else {
    const Tensor x4 = x2 * x2;
    even += 5 * x2 / 44 + x4 / 792 + x4 * x2 / 665280;
    odd += x * (x2 / 66 + x4 / 15840);
  }
  Tensor e = (even - odd).inverse() * (even + odd);
  for (; halvings > 0; --halvings) e = (e * e).eval();
  return e;
}

Tensor logarithm(const Tensor& b) {
  // log B = 2 artanh X, X = (B - 1)(B + 1)^-1
  const Tensor x = (b - Tensor::Identity()) * (b + Tensor::Identity()).inverse(), x2 = x * x;
  Tensor power = x, sum = x;
  for (int term = 3; term < 4000; term += 2) {
    power = (power * x2).eval();
    sum += power / term;
    if (size_of(power) <= 1e-17 * size_of(sum)) return 2 * sum;
  }
  throw std::runtime_error("an increment of deformation too large to be taken at once");
}

Tensor rotation_of(const Tensor& gradient) {
  if (in_plane(gradient)) {
    const double cosine = gradient(0, 0) + gradient(1, 1), sine = gradient(1, 0) - gradient(0, 1);
    const double length = std::hypot(cosine, sine);
    const double c = cosine / length, s = sine / length;
    return Tensor{{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
  }
  // Newton's iteration to the nearest rotation, scaled (Higham 1986, SIAM J. Sci. Stat. Comput. 7:1160).
  Tensor r = gradient;
  for (int i = 0; i < 50; ++i) {
    const Tensor inverse = r.inverse();
    const double scale = std::sqrt(inverse.norm() / r.norm());
    const Tensor next = 0.5 * (scale * r + inverse.transpose() / scale);
    const double change = size_of(next - r);
    r = next;
    if (!(change > 1e-15)) break;
  }
  return r;
}

Kinematics motion_by_gradient(const Tensor& gradient_old, const Tensor& velocity_gradient_dt) {
  return decomposed(gradient_old, exponential(velocity_gradient_dt) * gradient_old, velocity_gradient_dt);
}

Kinematics motion_between(const Tensor& gradient_old, const Tensor& gradient_new) {
  return decomposed(gradient_old, gradient_new, logarithm(gradient_new * gradient_old.inverse()));
}

Kinematics motion_by_strain(const Tensor& gradient_old, const Tensor& strain) {
  const Tensor rotation = rotation_of(gradient_old);
  const Tensor stretch = symmetric_part(rotation.transpose() * gradient_old);
  // The spin w for which exp(strain + w) U is symmetric: none where strain and U have the same axes.
  const Tensor inertia = stretch.trace() * Tensor::Identity() - stretch;
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  Tensor moved = exponential(strain) * stretch;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d skewed = axial(moved);
    if (!(skewed.norm() > 1e-16 * size_of(moved))) break;
    spin -= 2 * inertia.inverse() * skewed;
    moved = exponential(strain + skew(spin)) * stretch;
  }
  const Tensor stretch_new = symmetric_part(moved);
  return {gradient_old, rotation * stretch_new, rotation, rotation, stretch, stretch_new, strain, spin};
}

} // namespace host
