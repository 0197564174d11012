// SPDX-License-Identifier: BSD-3-Clause
// The pair of host/momentum.hpp in three dimensions, where all weights are 1 and the sums can be taken apart
// into fewer operations: with g = V_j grad W_ij = w x,
//   sum (sigma_i + sigma_j) g = sigma_i sum g + sum sigma_j g,   sum (s_i - s_j) w = s_i sum w - sum s_j w.
// The reduced stress s is the stress less geostatic part, linear in z, so that its share is a multiple of sum g_z.
#pragma once
#include "host/geometry.hpp"
#include "host/kernel.hpp"
#include "host/records.hpp"

namespace host {

/// A particle (or eight) as the pair function sees it.
template <class Real> struct SolidSide {
  Real position[3], velocity[3], density, damping_speed, strain_rate[6];
};

/// Sums over the neighbours of a particle (or of eight).
template <class Real> struct SolidSums {
  Real weight{};          ///< w
  Real slope[3]{};        ///< g
  Real stress_force[3]{}; ///< sigma_j g
  Real stress[6]{};       ///< sigma_j w
  Real viscous[3]{};
};

/// Additions and multiplications of one pair; square root and division count as one.
inline constexpr double solid_pair_flops = 101;

/// Adds the neighbour `j`; `diffuses` is false for images behind walls.
template <bool diffuses, class Real>
inline void add_pair(const Kernel<3>& kernel, const SolidSide<Real>& i,
                     const StressRecord<ThreeDimensional>& j, SolidSums<Real>& sums) {
  Real x[3], g[3], product[6];
  for (int a = 0; a < 3; ++a) x[a] = i.position[a] - j.position[a];
  for (int c = 0; c < 6; ++c) product[c] = x[c % 3] * x[c < 3 ? c : (c + 1) % 3];
  const Real r2 = product[0] + product[1] + product[2];
  const Real w = kernel.gradient_factor(square_root(r2)) * j.volume;
  for (int a = 0; a < 3; ++a) {
    g[a] = w * x[a];
    sums.slope[a] += g[a];
  }
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) sums.stress_force[a] += j.flux[component<3>(a, b)] * g[b];
  if constexpr (diffuses) {
    sums.weight += w;
    for (int c = 0; c < 6; ++c) sums.stress[c] += w * j.flux[c];
  }
  // The approach v . x less its resolved part, of the same sign as the whole and not larger.
  Real whole{}, twice_linear{};
  for (int a = 0; a < 3; ++a) whole += (i.velocity[a] - j.velocity[a]) * x[a];
  for (int c = 0; c < 6; ++c) twice_linear += (i.strain_rate[c] + j.strain_rate[c]) * product[c];
  const Real approach =
      smaller(larger(whole - 0.5 * twice_linear, smaller(whole, Real{})), larger(whole, Real{}));
  const Real mean = (i.damping_speed + j.damping_speed) * (i.density + j.density);
  const Real pressure = (0.25 * kernel.h) * mean * approach / (r2 + 0.01 * kernel.h * kernel.h);
  for (int a = 0; a < 3; ++a) sums.viscous[a] += pressure * g[a];
}

} // namespace host
