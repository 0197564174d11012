// SPDX-License-Identifier: BSD-3-Clause
// Velocity gradient, exact for a linear velocity field at any arrangement of neighbours (Bonet and
// Lok 1999, Comput. Methods Appl. Mech. Eng. 180:97):
//   grad v_i = [ sum_j V_j (v_j - v_i) (x) grad W_ij ] L_i,   L_i = [ sum_j V_j (x_j - x_i) (x) grad W_ij ]^-1.
#pragma once
#include "host/scheme/kernel.hpp"
#include "host/scheme/moment_matrix.hpp"
#include "host/scheme/records.hpp"

namespace host {

/// Sums over the neighbours of a particle (or of eight): the moment matrix, symmetric, upper triangle
/// row by row, and the uncorrected gradient, component a * D + b.
template <int D, class Real> struct GradientSums {
  Real moment[D * (D + 1) / 2]{};
  Real gradient[D * D]{};

  void scale(double factor) {
    for (Real& m : moment) m *= factor;
    for (Real& g : gradient) g *= factor;
  }
};

/// Additions and multiplications of one neighbour; square root and division count as one.
template <int D> constexpr double gradient_flops = 6 * D + 6 + 2 * D* D + D*(D + 1);

/// W'(r)/r over the kernel's scale, of the neighbour `j` seen from `position`. It is the same from both sides.
template <int D, class Real>
inline Real pair_shape(const Kernel<D>& kernel, const Real (&position)[D], const MotionRecord<D>& j) {
  Real square{};
  for (int a = 0; a < D; ++a) square += (position[a] - j.position[a]) * (position[a] - j.position[a]);
  return doubled(kernel.pair_shape(square));
}

/// Adds the neighbour `j`, which has the kernel's `shape`, seen from `position` and `velocity`.
template <int D, class Real>
inline void add_neighbour(const Real& shape, const Real (&position)[D], const Real (&velocity)[D],
                          const MotionRecord<D>& j, GradientSums<D, Real>& sums) {
  const Real weight = shape * j.volume;
  Real x[D], slope[D]; // V_j dW/dx_b
  for (int b = 0; b < D; ++b) {
    x[b] = position[b] - j.position[b];
    slope[b] = weight * x[b];
  }
  for (int a = 0, m = 0; a < D; ++a) {
    const Real dv = j.velocity[a] - velocity[a];
    for (int b = 0; b < D; ++b) sums.gradient[a * D + b] += dv * slope[b];
    for (int b = a; b < D; ++b) sums.moment[m++] -= x[a] * slope[b];
  }
}

/// Velocity gradient, 1/s, component a * D + b, from the sums over all neighbours, which must have been multiplied by
/// the kernel's scale.
template <int D, class Real> inline void correct_gradient(const GradientSums<D, Real>& sums, Real* gradient) {
  Real inverse[D * D];
  invert_moment(sums.moment, inverse);
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) {
      Real corrected{};
      for (int e = 0; e < D; ++e) corrected += sums.gradient[a * D + e] * inverse[e * D + b];
      gradient[a * D + b] = corrected;
    }
}

} // namespace host
