// SPDX-License-Identifier: BSD-3-Clause
// SIMSAND, critical state model of sand: state, status and update of one point, as pure functions without
// exceptions or allocation. Equations and signs: EQUATIONS.md. Compression positive; stress in the unit of p_at.
#pragma once
#include "vumat/functions.hpp"
#include "vumat/tensor.hpp"

namespace simsand {

/// A material point between two updates.
template <class Real, int N> struct Point {
  SymmetricTensor<Real, N> stress; ///< compression positive
  Real void_ratio = 0;
  Real plastic_strain = 0;    ///< eps_d (11)
  Real separation_strain = 0; ///< positive: stress free
};

template <class Real, int N> struct Update {
  Point<Real, N> point;
  Status status;
  Real dissipation; ///< plastic work per volume, stress unit
  bool nonconvex;   ///< plastic, with (7) beyond its convex range
};

/// Whether a point and a strain increment are finite and the state is one that an update may start from.
template <class Real, int N>
Mask<Real> admissible(const Point<Real, N>& point, const SymmetricTensor<Real, N>& strain) {
  Real sum = point.void_ratio + point.plastic_strain + abs(point.separation_strain);
  for (int c = 0; c < N; ++c) sum += abs(point.stress[c]) + abs(strain[c]);
  const Real zero = 0;
  return (sum <= std::numeric_limits<Scalar<Real>>::max()) & (point.void_ratio > zero) &
         (point.plastic_strain >= zero);
}

/// The point of the first update: void ratio e0, the stress on the yield surface.
template <class Real, int N>
Point<Real, N> initial_point(const Material<Real>& m, const SymmetricTensor<Real, N>& stress, Real e);

/// The point after a strain increment.
template <class Real, int N>
Update<Real, N> update(const Material<Real>& m, const Point<Real, N>& old,
                       const SymmetricTensor<Real, N>& strain_increment) noexcept;

/// Isotropic linear elastic answer with the moduli of the point as it stands.
template <class Real, int N>
SymmetricTensor<Real, N> elastic_stress(const Material<Real>& m, const Point<Real, N>& point,
                                        const SymmetricTensor<Real, N>& strain_increment);

} // namespace simsand
