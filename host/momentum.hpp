// SPDX-License-Identifier: BSD-3-Clause
// Accelerations from stress, symmetric in the pair, so that momentum is exchanged and none is made. With w the
// weight of the geometry (r or 1),
//   a_i = 1/(rho_i w_i) sum_j V_j (w_i sigma_i + w_j sigma_j + w_ij pi_ij 1) grad W_ij - hoop terms,
// with pi_ij the artificial viscosity and, in axisymmetry, sigma_33 / (rho r) taken off the radial
// acceleration. The viscosity (form of Monaghan 1992, Annu. Rev. Astron. Astrophys. 30:543) acts on what is
// left of a velocity difference once the velocity gradients of both sides are taken off (Frontiere, Raskin
// and Owen 2017, J. Comput. Phys. 332:160): it damps noise between particles and leaves a resolved flow,
// compression and shear alike, undissipated.
#pragma once
#include "host/geometry.hpp"
#include "host/kernel.hpp"
#include "host/neighbours.hpp"
#include "host/scene.hpp"

namespace host {

/// A particle (or eight) as the pair functions see it; the same quantities as a StressRecord.
template <class Geometry, class Real> struct PairSide {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  Real position[D], velocity[D], weight, density, damping_speed, flux[S], gradient[D * D], reduced_stress[S];
};

/// Distance vector and V_j W'(r)/r of a pair.
template <int D, class Real> struct Pair { Real x[D], r2{}, w; };

template <class Geometry, class Real>
inline Pair<Geometry::dimension, Real> make_pair(const Kernel<Geometry::dimension>& kernel,
                                                 const PairSide<Geometry, Real>& i,
                                                 const StressRecord<Geometry>& j) {
  Pair<Geometry::dimension, Real> pair;
  for (int a = 0; a < Geometry::dimension; ++a) {
    pair.x[a] = i.position[a] - j.position[a];
    pair.r2 += pair.x[a] * pair.x[a];
  }
  pair.w = kernel.gradient_factor(square_root(pair.r2)) * j.volume;
  return pair;
}

/// Adds (w_i sigma_i + w_j sigma_j) V_j grad W.
template <class Geometry, class Real, int D>
inline void add_stress_force(const Pair<D, Real>& pair, const PairSide<Geometry, Real>& i,
                             const StressRecord<Geometry>& j, Real (&force)[D]) {
  for (int a = 0; a < D; ++a) {
    Real sum{};
    for (int b = 0; b < D; ++b) {
      const int c = component<D>(a, b);
      sum += (i.flux[c] + j.flux[c]) * pair.x[b];
    }
    force[a] += sum * pair.w;
  }
}

/// The part of v_ij . x_ij that the mean velocity gradient does not explain: of the same sign as the whole
/// and not larger, else 0, so that the viscosity always dissipates.
template <class Geometry, class Real, int D>
inline Real unresolved_approach(const Pair<D, Real>& pair, const PairSide<Geometry, Real>& i,
                                const StressRecord<Geometry>& j) {
  Real whole{}, twice_linear{};
  for (int a = 0; a < D; ++a) {
    whole += (i.velocity[a] - j.velocity[a]) * pair.x[a];
    for (int b = 0; b < D; ++b)
      twice_linear += (i.gradient[a * D + b] + j.gradient[a * D + b]) * pair.x[a] * pair.x[b];
  }
  const Real rest = whole - 0.5 * twice_linear;
  return smaller(larger(rest, Real{}), larger(whole, Real{})) +
         larger(smaller(rest, Real{}), smaller(whole, Real{}));
}

/// Adds the viscous pressure s h rho (v . x)/(r2 + 0.01 h2), s the mean damping speed and v . x without its
/// resolved part.
template <class Geometry, class Real, int D>
inline void add_viscous_force(const Kernel<D>& kernel, const Pair<D, Real>& pair,
                              const PairSide<Geometry, Real>& i, const StressRecord<Geometry>& j,
                              Real (&force)[D]) {
  const Real mean =
      (i.damping_speed + j.damping_speed) * (i.density + j.density) * (i.weight + std::abs(j.weight));
  const Real pressure =
      (0.125 * kernel.h) * mean * unresolved_approach(pair, i, j) / (pair.r2 + 0.01 * kernel.h * kernel.h);
  for (int a = 0; a < D; ++a) force[a] += pressure * pair.w * pair.x[a];
}

/// Adds V_j (s_i - s_j) W'/r, with s the reduced stress: times twice the diffusivity, the rate of stress
/// diffusion (Feng et al. 2021, Comput. Geotech. 140:104356).
template <class Geometry, class Real, int D, int S>
inline void add_stress_diffusion(const Pair<D, Real>& pair, const PairSide<Geometry, Real>& i,
                                 const StressRecord<Geometry>& j, Real (&rate)[S]) {
  for (int s = 0; s < S; ++s) rate[s] += (i.reduced_stress[s] - j.reduced_stress[s]) * pair.w;
}

/// Diffusivity of stress, m2/s: delta h2 |grad v|, so that noise is smoothed as it arises, by strain, and a
/// deposit at rest keeps its stress; at most 0.1 h c, where it would limit the step.
template <class Real, int N>
inline Real stress_diffusivity(double delta, double h, const Real& wave_speed, const Real (&gradient)[N]) {
  Real square{};
  for (const Real& g : gradient) square += g * g;
  return smaller(Real(delta * h * h * square_root(square)), Real(0.1 * h * wave_speed));
}

/// Accelerations of all particles by stress, by viscosity and by walls, and the rate of stress diffusion,
/// from `records.stress`. Gravity and friction are not in them.
template <class Geometry>
void update_acceleration(Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                         const NeighbourLists& lists, const Records<Geometry>& records, const Scene& scene);

/// The same in three dimensions, by host/momentum_solid.hpp.
template <>
void update_acceleration(Particles<ThreeDimensional>& particles, const Kernel<3>& kernel,
                         const NeighbourLists& lists, const Records<ThreeDimensional>& records,
                         const Scene& scene);

} // namespace host
