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
// of the vertical sum g. What becomes of the sums: host/scheme/forces.hpp.
#pragma once
#include "host/scheme/kernel.hpp"
#include "host/scheme/records.hpp"
#include <cmath>

namespace host {

/// A particle (or eight) as the pair function sees it.
template <class Geometry, class Real> struct PairSide {
  static constexpr int D = Geometry::dimension;
  Real position[D], velocity[D], weight;
  Single<Real> density, damping_speed, strain_rate[D * (D + 1) / 2]; ///< only the viscosity reads these
  Single<Real> radius; ///< the first coordinate, which in axisymmetry is the weight; for the viscosity too
};

/// That of one particle, from its records.
template <class Geometry, int D = Geometry::dimension>
PairSide<Geometry, double> pair_side(const MotionRecord<D>& motion, const StressRecord<Geometry>& stress) {
  PairSide<Geometry, double> side;
  for (int a = 0; a < D; ++a) {
    side.position[a] = motion.position[a];
    side.velocity[a] = motion.velocity[a];
  }
  side.weight = Geometry::weight(motion.position[0]);
  side.radius = float(motion.position[0]);
  side.density = stress.density;
  side.damping_speed = stress.damping_speed;
  for (int c = 0; c < D * (D + 1) / 2; ++c) side.strain_rate[c] = stress.strain_rate[c];
  return side;
}

/// Sums over the neighbours of a particle (or of eight), with g = V_j grad W_ij = w x.
template <class Geometry, class Real> struct PairSums {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  Real weight{};          ///< w
  Real slope[D]{};        ///< g
  Real stress_force[D]{}; ///< w_j sigma_j g
  Real stress[S]{};       ///< sigma_j w
  Real viscous[D]{}; ///< 4/h times the artificial pressure times g (axisymmetry: 8/h and the mean radius)

  void scale(double factor) {
    weight *= factor;
    for (auto* group : {slope, stress_force, viscous})
      for (int a = 0; a < D; ++a) group[a] *= factor;
    for (Real& s : stress) s *= factor;
  }
};

/// Additions and multiplications of one pair; square root and division count as one.
template <class Geometry>
constexpr double pair_flops = Geometry::dimension == 3 ? 106 : (Geometry::hoop ? 73 : 69);

/// 4/h times the artificial pressure of a pair (in axisymmetry 8/h times that times the mean radius): `x` apart, with
/// `whole` = (v_i - v_j) . x and `square` = r2 + 0.01 h2. The part of `whole` that the mean velocity gradient does not
/// explain counts where it is of the same sign as the whole and not larger, so that the viscosity always dissipates.
/// In single precision, the same from both sides, so that one particle gets what the other loses.
template <class Geometry, class Real, int D>
inline Single<Real> viscous_pressure(const PairSide<Geometry, Real>& i, const MotionRecord<D>& m,
                                     const StressRecord<Geometry>& j, const Single<Real> (&x)[D],
                                     const Single<Real>& whole, const Single<Real>& square) {
  using Number = Single<Real>;
  const Number zero = i.density - i.density; // against a constant, GCC 12 makes two instructions of `larger`
  Number twice_linear{};
  for (int c = 0; c < D * (D + 1) / 2; ++c)
    twice_linear += (i.strain_rate[c] + j.strain_rate[c]) * (x[first_axis<D>(c)] * x[second_axis<D>(c)]);
  const Number approach =
      smaller(larger(whole - 0.5f * twice_linear, smaller(whole, zero)), larger(whole, zero));
  Number mean = (i.damping_speed + j.damping_speed) * (i.density + j.density);
  if constexpr (Geometry::hoop) mean *= i.radius + std::abs(float(m.position[0]));
  return mean * approach / square;
}

/// What is the same from both sides of a pair. A loop computes them for some pairs before it adds any of these, so
/// that square roots and divisions overlap.
template <class Real> struct PairFactors {
  Real shape;    ///< W'(r)/r over the kernel's scale
  Real pressure; ///< of the viscosity, as above
};
template <class Geometry, class Real, int D>
inline PairFactors<Real> pair_factors(const Kernel<D>& kernel, const PairSide<Geometry, Real>& i,
                                      const MotionRecord<D>& m, const StressRecord<Geometry>& j) {
  Real square{}, whole{};
  Single<Real> single_x[D];
  for (int a = 0; a < D; ++a) {
    const Real x = i.position[a] - m.position[a];
    square += x * x;
    whole += (i.velocity[a] - m.velocity[a]) * x;
    single_x[a] = single(x);
  }
  const auto pressure =
      viscous_pressure(i, m, j, single_x, single(whole), single(square + 0.01 * kernel.h * kernel.h));
  return {doubled(kernel.pair_shape(square)), doubled(pressure)};
}

/// Adds the neighbour of motion `m` and stress `j`; `diffuses` is false for images behind walls.
template <bool diffuses, class Geometry, class Real, int D>
inline void add_pair(const PairFactors<Real>& factors, const PairSide<Geometry, Real>& i,
                     const MotionRecord<D>& m, const StressRecord<Geometry>& j,
                     PairSums<Geometry, Real>& sums) {
  const Real weight = factors.shape * m.volume;
  Real g[D], weighted[D];
  for (int a = 0; a < D; ++a) {
    g[a] = weight * (i.position[a] - m.position[a]);
    weighted[a] = Geometry::hoop ? g[a] * m.position[0] : g[a];
    sums.slope[a] += g[a];
    sums.viscous[a] += factors.pressure * g[a];
  }
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) sums.stress_force[a] += j.stress[component<D>(a, b)] * weighted[b];
  if constexpr (diffuses) {
    sums.weight += weight;
    for (int s = 0; s < Geometry::stress_components; ++s) sums.stress[s] += weight * j.stress[s];
  }
}

} // namespace host
