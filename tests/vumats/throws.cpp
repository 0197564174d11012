// SPDX-License-Identifier: BSD-3-Clause
// PROPS: a time (s), Young's modulus (Pa), Poisson's ratio, and 1 to throw something that is no std::exception.
// Elastic until totalTime has passed that time; then it throws.
#include "tests/vumats/elastic.hpp"
#include <stdexcept>

extern "C" __attribute__((visibility("default"))) void
vumat_(const int* nblock, const int*, const int* nshr, const int*, const int*, const int*, const int*,
       const double*, const double* total_time, const double*, const char*, const double*, const double*,
       const double* props, const double* density, const double* strain, const double*, const double*,
       const double*, const double*, const double*, const double* old, const double*,
       const double* energy_old, const double*, const double*, const double*, const double*, const double*,
       double* stress, double*, double* energy, double*, std::size_t) {
  test_vumats::elastic_block(*nblock, *nshr, props[1], props[2], density, strain, old, energy_old, stress,
                             energy);
  if (*total_time <= props[0]) return;
  if (props[3] == 1) throw 1;
  throw std::runtime_error("no tangent");
}
