// SPDX-License-Identifier: BSD-3-Clause
// Symmetric tensors of 6 components (11, 22, 33, 12, 23, 31) or, in plane strain and axisymmetry, of 4
// (11, 22, 33, 12). Shear as tensor components.
#pragma once
#include "vumat/lanes.hpp"

namespace simsand {

template <class Real, int N> struct SymmetricTensor {
  static_assert(N == 4 || N == 6);
  Real component[N]{};

  Real& operator[](int c) { return component[c]; }
  const Real& operator[](int c) const { return component[c]; }
};

/// a + factor b
template <class Real, int N>
SymmetricTensor<Real, N> add(SymmetricTensor<Real, N> a, Real factor, const SymmetricTensor<Real, N>& b) {
  for (int c = 0; c < N; ++c) a[c] += factor * b[c];
  return a;
}

template <class Real, int N> SymmetricTensor<Real, N> scale(Real factor, SymmetricTensor<Real, N> a) {
  for (int c = 0; c < N; ++c) a[c] = a[c] * factor;
  return a;
}

template <class Real, int N> Real trace(const SymmetricTensor<Real, N>& a) {
  return a[0] + a[1] + a[2];
}

/// a + pressure I
template <class Real, int N> SymmetricTensor<Real, N> add_mean(SymmetricTensor<Real, N> a, Real pressure) {
  for (int c = 0; c < 3; ++c) a[c] += pressure;
  return a;
}

template <class Real, int N> SymmetricTensor<Real, N> deviator(const SymmetricTensor<Real, N>& a) {
  return add_mean(a, -trace(a) / 3);
}

/// a : b; each shear component stands for two.
template <class Real, int N>
Real contract(const SymmetricTensor<Real, N>& a, const SymmetricTensor<Real, N>& b) {
  Real direct = 0, shear = 0;
  for (int c = 0; c < 3; ++c) direct += a[c] * b[c];
  for (int c = 3; c < N; ++c) shear += a[c] * b[c];
  return direct + 2 * shear;
}

template <class Real, int N> Real determinant(const SymmetricTensor<Real, N>& a) {
  if constexpr (N == 4)
    return a[2] * (a[0] * a[1] - a[3] * a[3]);
  else
    return a[0] * (a[1] * a[2] - a[4] * a[4]) - a[3] * (a[3] * a[2] - a[4] * a[5]) +
           a[5] * (a[3] * a[4] - a[1] * a[5]);
}

/// q = sqrt(3/2 s:s)
template <class Real, int N> Real deviatoric_stress(const SymmetricTensor<Real, N>& s) {
  return sqrt(Real(1.5) * contract(s, s));
}

/// sin 3theta of a deviator s with invariant q, compression positive: -1 in triaxial compression, +1 in
/// extension, 0 where q vanishes.
template <class Real, int N> Real sin_3theta(const SymmetricTensor<Real, N>& s, Real q) {
  const Real inverse = select(q > tiny<Scalar<Real>>, 1 / q, Real(0));
  const Real sine = Real(-13.5) * determinant(scale(inverse, s));
  return within(sine, -1, 1);
}

} // namespace simsand
