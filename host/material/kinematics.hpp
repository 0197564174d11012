// SPDX-License-Identifier: BSD-3-Clause
// The motion of a point as a VUMAT gets it: deformation gradient F, right stretch U, strain and relative
// spin of one increment in the corotational frame of Green and Naghdi, whose axes turn with R = F U^-1.
//
// Over an increment the velocity gradient L is constant, so that F_new = exp(L dt) F_old: a rigid rotation is
// exact, and det F is exp(tr L dt) times what it was. Strain is R_m^T sym(L dt) R_m, R_m half way between
// the rotations of both ends; spin is W dt less the rotation from R_old to R_new, in the same axes.
#pragma once
#include <Eigen/Core>
#include <array>

namespace host {

using Tensor = Eigen::Matrix3d;

/// Motion of one point over one increment. F in base axes, U, strain and spin in corotational ones.
struct Kinematics {
  Tensor gradient_old, gradient_new; ///< F
  Tensor rotation_old, rotation_new; ///< R
  Tensor stretch_old, stretch_new;   ///< U
  Tensor strain;                     ///< strainInc: symmetric, tension positive
  Eigen::Vector3d spin;              ///< relSpinInc about axes 1, 2, 3: components 32, 13, 21
};

/// exp(A), to round-off.
Tensor exponential(const Tensor& a);

/// The A of exp(A) = B that is next to zero. Throws std::runtime_error if B is too far from the identity: about 170
/// degrees, or a strain of 4, in one increment.
Tensor logarithm(const Tensor& b);

/// R of F = R U, for det F > 0.
Tensor rotation_of(const Tensor& gradient);

/// The motion from F_old with the velocity gradient times dt, in base axes.
Kinematics motion_by_gradient(const Tensor& gradient_old, const Tensor& velocity_gradient_dt);

/// The motion from F_old to a given F_new. Throws as logarithm().
Kinematics motion_between(const Tensor& gradient_old, const Tensor& gradient_new);

/// The motion from F_old = R U_old by a given corotational strain without any further rotation: R stays, and the spin is
/// the one that keeps U symmetric. A point that is led by stress and strain alone moves like this.
Kinematics motion_by_strain(const Tensor& gradient_old, const Tensor& strain);

/// Row and column of component c for `shear` shear components. Symmetric: 11, 22, 33, 12, 23, 31; after them, in
/// the non-symmetric order, 21, 32, 13. With one shear component 11, 22, 33, 12, then 21.
constexpr std::array<int, 2> place(int c, int shear) {
  if (c < 3) return {c, c};
  const int s = (c - 3) % shear, next = (s + 1) % 3;
  return c < 3 + shear ? std::array{s, next} : std::array{next, s};
}

/// Reads a symmetric tensor of point k from an array whose components are `n` apart ...
template <class Array> Tensor symmetric_at(const Array& a, int k, int n, int shear) {
  Tensor t = Tensor::Zero();
  for (int c = 0; c < 3 + shear; ++c) {
    const auto [row, column] = place(c, shear);
    t(row, column) = t(column, row) = a[c * n + k];
  }
  return t;
}

/// ... and writes it.
template <class Array> void set_symmetric(const Tensor& t, int k, int n, int shear, Array& a) {
  for (int c = 0; c < 3 + shear; ++c) a[c * n + k] = t(place(c, shear)[0], place(c, shear)[1]);
}

/// The same of a tensor that is not symmetric.
template <class Array> Tensor general_at(const Array& a, int k, int n, int shear) {
  Tensor t = Tensor::Zero();
  for (int c = 0; c < 3 + 2 * shear; ++c) t(place(c, shear)[0], place(c, shear)[1]) = a[c * n + k];
  return t;
}

template <class Array> void set_general(const Tensor& t, int k, int n, int shear, Array& a) {
  for (int c = 0; c < 3 + 2 * shear; ++c) a[c * n + k] = t(place(c, shear)[0], place(c, shear)[1]);
}

} // namespace host
