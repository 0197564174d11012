// SPDX-License-Identifier: BSD-3-Clause
// Accelerations from stress, symmetric in the pair, so that momentum is exchanged and none is made. With w the
// weight of the geometry (r or 1),
//   a_i = 1/(rho_i w_i) sum_j V_j (w_i sigma_i + w_j sigma_j + w_ij pi_ij 1) grad W_ij - hoop terms,
// with pi_ij the artificial viscosity and, in axisymmetry, sigma_33 / (rho r) taken off the radial
// acceleration. The viscosity (form of Monaghan 1992, Annu. Rev. Astron. Astrophys. 30:543) acts on what is
// left of a velocity difference once the velocity gradients of both sides are taken off (Frontiere, Raskin
// and Owen 2017, J. Comput. Phys. 332:160): it damps noise between particles and leaves a resolved flow,
// compression and shear alike, undissipated.
//
// The sums are taken apart into fewer operations: with g = V_j grad W_ij = w x,
//   sum (w_i sigma_i + w_j sigma_j) g = w_i sigma_i sum g + sum w_j sigma_j g,
//   sum (s_i - s_j) w = s_i sum w - sum s_j w,
// s the reduced stress, which is the stress less its geostatic part, linear in height, so that its share is a multiple
// of the vertical sum g. Stress diffuses by twice the diffusivity times that (Feng et al. 2021, Comput. Geotech.
// 140:104356).
#pragma once
#include "host/geometry.hpp"
#include "host/kernel.hpp"
#include "host/neighbours.hpp"
#include "host/scene.hpp"

namespace host {

/// A particle (or eight) as the pair function sees it.
template <class Geometry, class Real> struct PairSide {
  static constexpr int D = Geometry::dimension;
  Real position[D], velocity[D], weight, density, damping_speed, strain_rate[D * (D + 1) / 2];
};

/// Sums over the neighbours of a particle (or of eight), with g = V_j grad W_ij = w x.
template <class Geometry, class Real> struct PairSums {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  Real weight{};          ///< w
  Real slope[D]{};        ///< g
  Real stress_force[D]{}; ///< w_j sigma_j g
  Real stress[S]{};       ///< sigma_j w
  Real viscous[D]{};
};

/// Additions and multiplications of one pair; square root and division count as one.
template <class Geometry>
constexpr double pair_flops = Geometry::dimension == 3 ? 101 : (Geometry::hoop ? 65 : 61);

/// Axes of component c of the strain rate.
template <int D> constexpr int first_axis(int c) {
  return c < D ? c : (c - D) % D;
}
template <int D> constexpr int second_axis(int c) {
  return c < D ? c : (c - D + 1) % D;
}

/// What is slow to come by of a pair, and of nothing but its distance: W'(r)/r and 1/(r2 + 0.01 h2).
template <class Real> struct Reach { Real slope, inverse; };
template <class Geometry, class Real, int D>
inline Reach<Real> reach_of(const Kernel<D>& kernel, const PairSide<Geometry, Real>& i,
                            const MotionRecord<D>& m) {
  Real r2{};
  for (int a = 0; a < D; ++a) {
    const Real x = i.position[a] - m.position[a];
    r2 += x * x;
  }
  return {kernel.gradient_factor(square_root(r2)), 1.0 / (r2 + 0.01 * kernel.h * kernel.h)};
}

/// Adds the neighbour `j` with motion `m`; `diffuses` is false for images behind walls. The part of v_ij . x_ij that the
/// mean velocity gradient does not explain counts where it is of the same sign as the whole and not larger, so that
/// the viscosity always dissipates.
template <bool diffuses, class Geometry, class Real, int D>
inline void add_pair(const Reach<Real>& reach, const PairSide<Geometry, Real>& i, const MotionRecord<D>& m,
                     const StressRecord<Geometry>& j, PairSums<Geometry, Real>& sums) {
  constexpr int rates = D * (D + 1) / 2;
  Real x[D], g[D], product[rates];
  for (int a = 0; a < D; ++a) x[a] = i.position[a] - m.position[a];
  for (int c = 0; c < rates; ++c) product[c] = x[first_axis<D>(c)] * x[second_axis<D>(c)];
  const Real w = reach.slope * m.volume;
  for (int a = 0; a < D; ++a) {
    g[a] = w * x[a];
    sums.slope[a] += g[a];
  }
  const double weight = Geometry::weight(m.position[0]);
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) sums.stress_force[a] += (weight * j.stress[component<D>(a, b)]) * g[b];
  if constexpr (diffuses) {
    sums.weight += w;
    for (int s = 0; s < Geometry::stress_components; ++s) sums.stress[s] += w * j.stress[s];
  }
  Real whole{}, twice_linear{};
  for (int a = 0; a < D; ++a) whole += (i.velocity[a] - m.velocity[a]) * x[a];
  for (int c = 0; c < rates; ++c) twice_linear += (i.strain_rate[c] + double(j.strain_rate[c])) * product[c];
  const Real approach =
      smaller(larger(whole - 0.5 * twice_linear, smaller(whole, Real{})), larger(whole, Real{}));
  Real mean = (i.damping_speed + double(j.damping_speed)) * (i.density + double(j.density));
  if constexpr (Geometry::hoop) mean *= 0.5 * (i.weight + std::abs(weight));
  const Real pressure = mean * approach * reach.inverse;
  for (int a = 0; a < D; ++a) sums.viscous[a] += pressure * g[a];
}

/// What acts on the particles of one cluster: accelerations, m/s2, and the rate of stress diffusion, Pa/s.
template <class Geometry> struct ClusterForces {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  std::array<Lane, D> stress, viscous, wall;
  std::array<Lane, S> diffusion;
};

/// Of cluster c, from both records: by stress, by viscosity and by walls. Gravity and friction are not in them.
template <class Geometry>
ClusterForces<Geometry> forces_on(const Particles<Geometry>& particles,
                                  const Kernel<Geometry::dimension>& kernel, const NeighbourLists& lists,
                                  const Records<Geometry>& records, const Scene& scene, int c);

/// The same of all particles, kept.
template <class Geometry>
void update_acceleration(Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                         const NeighbourLists& lists, const Records<Geometry>& records, const Scene& scene);

} // namespace host
