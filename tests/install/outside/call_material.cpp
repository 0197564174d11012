// SPDX-License-Identifier: BSD-3-Clause
// One call of the material as a host makes it: a point under 10 kPa is compressed by 1e-6 in each direction. Prints the
// mean stress, compression positive, before and after, Pa.
#include "vumat/abi.hpp"
#include <cstdio>
#include <string>

extern "C" vumat::Subroutine<double> vumat_;

int main() {
  // The sand TS of Jin, Lu and Yang: K0, nu, n, phi, e_ref, lambda, zeta, A_d, k_p, n_p, n_d, e0, p_at, p_min.
  const double props[] = {100.0, 0.2,    0.51, 24.0, 0.76,   0.04,     0.3,
                          1.0,   0.0015, 3.3,  1.0,  0.4451, 101325.0, 1.0};
  const int points = 1, direct = 3, shear = 1, states = 5, fields = 0, constants = 14, annealing[4] = {};
  const double time = 1e-5, density = 1730, none[5] = {}, stress[] = {-1e4, -1e4, -1e4, 0};
  const double strain[] = {-1e-6, -1e-6, -1e-6, 0}, stretch[] = {1, 1, 1, 0}, gradient[] = {1, 1, 1, 0, 0};
  double stress_new[4] = {}, state_new[5] = {};
  double internal = 0, inelastic = 0;
  std::string name = "SIMSAND";
  name.resize(vumat::name_length, ' ');
  vumat_(&points, &direct, &shear, &states, &fields, &constants, annealing, &time, &time, &time, name.data(),
         none, none, props, &density, strain, none, none, stretch, gradient, none, stress, none, none, none,
         none, stretch, gradient, none, stress_new, state_new, &internal, &inelastic, name.size());
  std::printf("%.17g %.17g %.17g\n", 1e4, -(stress_new[0] + stress_new[1] + stress_new[2]) / 3, state_new[0]);
}
