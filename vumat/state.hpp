// SPDX-License-Identifier: BSD-3-Clause
// The state of a material point, and the outcome of its update.
#pragma once
#include "vumat/tensor.hpp"

namespace simsand {

/// Outcome of an update, as written to STATEV(4). A property refused is -100 - its position from 1.
enum class Status : int {
  elastic = 0,
  plastic = 1,
  stress_free = 2,
  substepped = 3,
  exhausted = -1,   ///< no solution within the bounded number of iterations and substeps
  bad_input = -2,   ///< stress, strain or state not finite, e not positive or eps_d negative
  unsupported = -3, ///< ndir, nshr or nstatev
  bad_property = -100
};

/// A material point between two updates.
template <class Real, int N> struct SoilState {
  SymmetricTensor<Real, N> stress; ///< compression positive
  Real void_ratio{};
  Real plastic_strain{};    ///< eps_d (11)
  Real separation_strain{}; ///< positive: stress free
};

/// Whether a state and a strain increment are finite and the state is one that an update may start from.
template <class Real, int N>
Mask<Real> is_admissible(const SoilState<Real, N>& state, const SymmetricTensor<Real, N>& strain) {
  Real sum = state.void_ratio + state.plastic_strain + abs(state.separation_strain);
  for (int c = 0; c < N; ++c) sum += abs(state.stress[c]) + abs(strain[c]);
  return (sum <= Real(std::numeric_limits<Scalar<Real>>::max())) & (state.void_ratio > 0) &
         (state.plastic_strain >= 0);
}

} // namespace simsand
