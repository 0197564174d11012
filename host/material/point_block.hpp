// SPDX-License-Identifier: BSD-3-Clause
// One point of a block of the VUMAT interface, as callers of single points have it: compression positive, components
// together. Every driver of single points packs its blocks here, and turns the sign here.
#pragma once
#include "host/material/block.hpp"
#include <span>

namespace host {

/// Writes point k: old stress and strain increment, of 3 + shear components each, and old state.
template <std::size_t components>
void pack_point(std::span<const double, components> stress,
                std::span<const double, components> strain_increment, std::span<const double> state, int k,
                VumatBlock& b) {
  const int n = b.points;
  for (std::size_t c = 0; c < components; ++c) {
    b.strain_increment[c * n + k] = -strain_increment[c];
    b.stress_old[c * n + k] = -stress[c];
  }
  for (int s = 0; s < b.state_variables; ++s) b.state_old[s * n + k] = state[s];
}

/// New stress of point k, 3 + shear components.
template <std::size_t components>
void unpack_stress(const VumatBlock& b, int k, std::span<double, components> stress) {
  for (std::size_t c = 0; c < components; ++c) stress[c] = -b.stress_new[c * b.points + k];
}

/// New state of point k.
inline void unpack_state(const VumatBlock& b, int k, std::span<double> state) {
  for (int s = 0; s < b.state_variables; ++s) state[s] = b.state_new[s * b.points + k];
}

/// Whether the material reports that the update of point k failed. `failure_state`: position in STATEV, from 0, of a
/// variable that is negative after a failed update; -1: there is none.
inline bool reports_failure(const VumatBlock& b, int k, int failure_state) {
  return failure_state >= 0 && b.state_new[failure_state * b.points + k] < 0;
}

/// Whether the answer for point k holds finite numbers alone and reports no failure.
inline bool is_usable(const VumatBlock& b, int k, int failure_state) {
  double sum =
      b.internal_energy_new[k] * 0 + b.inelastic_energy_new[k] * 0; // not 0 if any number is not finite
  for (int c = 0; c < 3 + b.shear_components; ++c) sum += b.stress_new[c * b.points + k] * 0;
  for (int s = 0; s < b.state_variables; ++s) sum += b.state_new[s * b.points + k] * 0;
  return sum == 0 && !reports_failure(b, k, failure_state);
}

} // namespace host
