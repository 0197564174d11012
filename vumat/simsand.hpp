// SPDX-License-Identifier: BSD-3-Clause
// SIMSAND, critical state model of sand: one material point, as pure functions without exceptions or allocation.
// Equations and signs: EQUATIONS.md. Compression positive; stress in the unit of p_at.
#pragma once
#include "vumat/integrals.hpp"
#include "vumat/state.hpp"

namespace simsand {

template <class T, int N> struct Update {
  SoilState<T, N> state;
  Status status;
  T dissipation;  ///< plastic work per volume, stress unit
  bool nonconvex; ///< plastic, with (7) beyond its convex range
};

/// The state of the first update: void ratio e, the stress on the yield surface.
template <class T, int N>
SoilState<T, N> initial_state(const Material<T>& m, const SymmetricTensor<T, N>& stress, T e);

/// The state after a strain increment. Where it fails, the old state.
template <class T, int N>
Update<T, N> update(const Material<T>& m, const SoilState<T, N>& old,
                    const SymmetricTensor<T, N>& strain_increment) noexcept;

/// Isotropic linear elastic answer with the moduli of the state as it stands.
template <class T, int N>
SymmetricTensor<T, N> elastic_stress(const Material<T>& m, const SoilState<T, N>& state,
                                     const SymmetricTensor<T, N>& strain_increment);

} // namespace simsand
