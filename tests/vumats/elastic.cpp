// SPDX-License-Identifier: BSD-3-Clause
// PROPS: Young's modulus (Pa), Poisson's ratio. STATEV(1) counts the increments, data checks left out.
#include "tests/vumats/elastic.hpp"

extern "C" __attribute__((visibility("default"))) void
vumat_(const int* nblock, const int*, const int* nshr, const int* nstatev, const int*, const int*, const int*,
       const double*, const double* total_time, const double*, const char*, const double*, const double*,
       const double* props, const double* density, const double* strain, const double*, const double*,
       const double*, const double*, const double*, const double* old, const double* state_old,
       const double* energy_old, const double*, const double*, const double*, const double*, const double*,
       double* stress, double* state, double* energy, double*, std::size_t) {
  test_vumats::elastic_block(*nblock, *nshr, props[0], props[1], density, strain, old, energy_old, stress,
                             energy);
  for (int k = 0; k<*nblock&& * nstatev> 0; ++k) state[k] = state_old[k] + (*total_time > 0);
}
