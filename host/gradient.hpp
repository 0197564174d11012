// SPDX-License-Identifier: BSD-3-Clause
// Velocity gradient, exact for a linear velocity field at any arrangement of neighbours (Bonet and
// Lok 1999, Comput. Methods Appl. Mech. Eng. 180:97):
//   grad v_i = [ sum_j V_j (v_j - v_i) (x) grad W_ij ] L_i,   L_i = [ sum_j V_j (x_j - x_i) (x) grad W_ij ]^-1.
#pragma once
#include "host/kernel.hpp"
#include "host/neighbours.hpp"

namespace host {

/// Sums over the neighbours of a particle (or of eight): the moment matrix, symmetric, upper triangle
/// row by row, and the uncorrected gradient, component a * D + b.
template <int D, class Real> struct GradientSums {
  Real moment[D * (D + 1) / 2]{};
  Real gradient[D * D]{};
};

/// Adds the neighbour `j` seen from `position`, `velocity`.
template <int D, class Real>
inline void add_neighbour(const Kernel<D>& kernel, const Real (&position)[D], const Real (&velocity)[D],
                          const MotionRecord<D>& j, GradientSums<D, Real>& sums) {
  Real x[D], r2{};
  for (int a = 0; a < D; ++a) {
    x[a] = position[a] - j.position[a];
    r2 += x[a] * x[a];
  }
  const Real w = kernel.gradient_factor(square_root(r2)) * j.volume;
  Real slope[D]; // V_j dW/dx_b
  for (int b = 0; b < D; ++b) slope[b] = w * x[b];
  for (int a = 0, m = 0; a < D; ++a) {
    const Real dv = j.velocity[a] - velocity[a];
    for (int b = 0; b < D; ++b) sums.gradient[a * D + b] += dv * slope[b];
    for (int b = a; b < D; ++b) sums.moment[m++] -= x[a] * slope[b];
  }
}

/// Inverse of the moment matrix (upper triangle `m`) in two dimensions. Where neighbours are missing so
/// far that its smallest eigenvalue is below `least_support` (1: complete; about one half in the surface
/// layer), the matrix is shifted up to there: a grain in flight must not divide by nothing.
template <class Real> inline void invert_moment(const Real (&m)[3], Real (&inverse)[4]) {
  constexpr double least_support = 0.25;
  const Real half_trace = 0.5 * (m[0] + m[2]), half_difference = 0.5 * (m[0] - m[2]);
  const Real smallest = half_trace - square_root(half_difference * half_difference + m[1] * m[1]);
  const Real shift = larger(least_support - smallest, Real{});
  const Real a = m[0] + shift, c = m[2] + shift;
  const Real scale = 1.0 / (a * c - m[1] * m[1]);
  inverse[0] = c * scale;
  inverse[1] = inverse[2] = -m[1] * scale;
  inverse[3] = a * scale;
}

/// Fills `records.motion` of the particles (not of the images).
template <class Geometry> void show_motion(const Particles<Geometry>& particles, Records<Geometry>& records);

/// Velocity gradient of all particles, from `records.motion`.
template <class Geometry>
void update_gradient(Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                     const NeighbourLists& lists, const Records<Geometry>& records);

} // namespace host
