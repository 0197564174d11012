// SPDX-License-Identifier: BSD-3-Clause
// Linear isotropic elasticity behind the VUMAT interface, for tests of a host.
#pragma once
#include "vumat/abi.hpp"

namespace test_vumats {

/// stress += lambda tr(strain) 1 + 2 G strain for all points; the energy grows by the mean stress power.
inline void elastic_block(int points, int shear_components, double young, double poisson,
                          const double* density, const double* strain, const double* old,
                          const double* energy_old, double* stress, double* energy) {
  const double twice_g = young / (1 + poisson), lambda = twice_g * poisson / (1 - 2 * poisson);
  for (int k = 0; k < points; ++k) {
    const double volume = strain[k] + strain[points + k] + strain[2 * points + k];
    energy[k] = energy_old[k];
    for (int c = 0; c < 3 + shear_components; ++c) {
      const int i = c * points + k;
      stress[i] = old[i] + twice_g * strain[i] + (c < 3 ? lambda * volume : 0);
      energy[k] += (c < 3 ? 1 : 2) * 0.5 * (old[i] + stress[i]) * strain[i] / density[k];
    }
  }
}

} // namespace test_vumats
