// SPDX-License-Identifier: BSD-3-Clause
// The state of a material point.
#pragma once
#include "vumat/parameters.hpp"
#include "vumat/tensor.hpp"

namespace simsand {

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
