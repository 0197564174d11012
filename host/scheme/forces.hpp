// SPDX-License-Identifier: BSD-3-Clause
// What becomes of the sums over the pairs of a particle (host/scheme/pair.hpp) when all neighbours are added and the
// sums have been multiplied by the kernel's scale: accelerations by stress and viscosity, and the rate at which stress
// diffuses (Feng et al. 2021, Comput. Geotech. 140:104356). Functions of one particle or of eight.
#pragma once
#include "host/scheme/medium.hpp"
#include "host/scheme/pair.hpp"
#include <array>

namespace host {

/// The particle's own share in its forces.
template <class Geometry, class Real> struct OwnStress {
  Real stress[Geometry::stress_components]; ///< Pa
  Real inverse_density;                     ///< m3/kg
  Real inverse_weight;                      ///< 1/r, 1/m, in axisymmetry, else 1
};

/// Accelerations, m/s2.
template <class Geometry, class Real> struct PairAcceleration {
  std::array<Real, Geometry::dimension> stress, viscous;
};

/// Force of the stress of pairs on a unit of volume, N/m3: (w_i sigma_i sum g + sum w_j sigma_j g) / w_i.
template <class Geometry, class Real, int D>
inline void stress_force(const OwnStress<Geometry, Real>& own, const PairSums<Geometry, Real>& sums,
                         Real (&force)[D]) {
  for (int a = 0; a < D; ++a) {
    force[a] = sums.stress_force[a];
    if constexpr (Geometry::hoop) force[a] *= own.inverse_weight;
    for (int b = 0; b < D; ++b) force[a] += own.stress[component<D>(a, b)] * sums.slope[b];
  }
}

/// What turns the viscous sum into an acceleration.
template <class Geometry, class Real>
inline Real viscous_scale(const OwnStress<Geometry, Real>& own, double smoothing_length) {
  Real scale = (0.25 * smoothing_length) * own.inverse_density;
  if constexpr (Geometry::hoop) scale *= 0.5 * own.inverse_weight;
  return scale;
}

/// Acceleration by the particles around, with that of the hoop stress.
template <class Geometry, class Real>
inline PairAcceleration<Geometry, Real> finish_pairs(const OwnStress<Geometry, Real>& own,
                                                     const PairSums<Geometry, Real>& sums,
                                                     double smoothing_length) {
  constexpr int D = Geometry::dimension;
  Real force[D];
  stress_force(own, sums, force);
  if constexpr (Geometry::hoop) force[0] -= own.stress[2] * own.inverse_weight;
  const Real damping = viscous_scale(own, smoothing_length);
  PairAcceleration<Geometry, Real> by;
  for (int a = 0; a < D; ++a) {
    by.stress[a] = force[a] * own.inverse_density;
    by.viscous[a] = sums.viscous[a] * damping;
  }
  return by;
}

/// Acceleration by images behind walls, m/s2: stress and viscosity together.
template <class Geometry, class Real>
inline std::array<Real, Geometry::dimension> finish_images(const OwnStress<Geometry, Real>& own,
                                                           const PairSums<Geometry, Real>& sums,
                                                           double smoothing_length) {
  constexpr int D = Geometry::dimension;
  Real force[D];
  stress_force(own, sums, force);
  const Real damping = viscous_scale(own, smoothing_length);
  std::array<Real, D> by_walls;
  for (int a = 0; a < D; ++a) by_walls[a] = force[a] * own.inverse_density + sums.viscous[a] * damping;
  return by_walls;
}

/// Rate of stress by diffusion, Pa/s: twice the diffusivity, m2/s, times the sum of the differences of reduced stress.
template <class Geometry, class Real>
inline std::array<Real, Geometry::stress_components>
diffusion_rate(const OwnStress<Geometry, Real>& own, const PairSums<Geometry, Real>& sums,
               const Real& diffusivity, const Medium& medium) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  const double unit_weight = medium.unit_weight();
  const Real twice_diffusivity = 2 * diffusivity;
  std::array<Real, S> rates;
  for (int s = 0; s < S; ++s) {
    Real rate = own.stress[s] * sums.weight - sums.stress[s];
    if (s < 3) rate -= (s == D - 1 ? 1 : medium.earth_pressure_ratio) * unit_weight * sums.slope[D - 1];
    rates[s] = rate * twice_diffusivity;
  }
  return rates;
}

} // namespace host
