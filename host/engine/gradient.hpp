// SPDX-License-Identifier: BSD-3-Clause
// Velocity gradient, exact for a linear velocity field at any arrangement of neighbours (Bonet and
// Lok 1999, Comput. Methods Appl. Mech. Eng. 180:97):
//   grad v_i = [ sum_j V_j (v_j - v_i) (x) grad W_ij ] L_i,   L_i = [ sum_j V_j (x_j - x_i) (x) grad W_ij ]^-1.
#pragma once
#include "host/engine/neighbours.hpp"
#include "host/scheme/kernel.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

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

/// V_j W'(r)/r over the kernel's scale, of the neighbour `j` seen from `position`.
template <int D, class Real>
inline Real pair_weight(const Kernel<D>& kernel, const Real (&position)[D], const MotionRecord<D>& j) {
  Real square{};
  for (int a = 0; a < D; ++a) square += (position[a] - j.position[a]) * (position[a] - j.position[a]);
  return doubled(kernel.pair_shape(square)) * j.volume;
}

/// Adds the neighbour `j` of weight `w` seen from `position`, `velocity`.
template <int D, class Real>
inline void add_neighbour(const Real& w, const Real (&position)[D], const Real (&velocity)[D],
                          const MotionRecord<D>& j, GradientSums<D, Real>& sums) {
  Real x[D], slope[D]; // V_j dW/dx_b
  for (int b = 0; b < D; ++b) {
    x[b] = position[b] - j.position[b];
    slope[b] = w * x[b];
  }
  for (int a = 0, m = 0; a < D; ++a) {
    const Real dv = j.velocity[a] - velocity[a];
    for (int b = 0; b < D; ++b) sums.gradient[a * D + b] += dv * slope[b];
    for (int b = a; b < D; ++b) sums.moment[m++] -= x[a] * slope[b];
  }
}

/// Where neighbours are missing so far that the smallest eigenvalue of the moment matrix is below this (1:
/// complete; about one half in the surface layer), the matrix is shifted up to there: a grain in flight must
/// not divide by nothing.
inline constexpr double least_support = 0.25;

/// Inverse of the moment matrix (upper triangle `m`) in two dimensions, with that shift.
template <class Real> inline void invert_moment(const Real (&m)[3], Real (&inverse)[4]) {
  const Real half_trace = 0.5 * (m[0] + m[2]), half_difference = 0.5 * (m[0] - m[2]);
  const Real smallest = half_trace - square_root(half_difference * half_difference + m[1] * m[1]);
  const Real shift = larger(least_support - smallest, Real{});
  const Real a = m[0] + shift, c = m[2] + shift;
  const Real scale = 1.0 / (a * c - m[1] * m[1]);
  inverse[0] = c * scale;
  inverse[1] = inverse[2] = -m[1] * scale;
  inverse[3] = a * scale;
}

/// What the smallest eigenvalue of a symmetric matrix (upper triangle) lacks to `least`; 0 if nothing.
inline double lacking_support(const double (&m)[6], double least) {
  const double a = m[0] - least, d = m[3] - least, f = m[5] - least;
  const double minor = a * d - m[1] * m[1];
  const double determinant = minor * f - a * m[4] * m[4] + m[2] * (2 * m[1] * m[4] - d * m[2]);
  if (a > 0 && minor > 0 && determinant > 0) return 0;
  // Eigenvalues of a symmetric 3x3 matrix by Smith 1961, Commun. ACM 4:168.
  const double mean = (m[0] + m[3] + m[5]) / 3;
  const double x = m[0] - mean, y = m[3] - mean, z = m[5] - mean;
  const double size = std::sqrt((x * x + y * y + z * z + 2 * (m[1] * m[1] + m[2] * m[2] + m[4] * m[4])) / 6);
  if (size == 0) return std::max(least - mean, 0.0);
  const double third =
      x * (y * z - m[4] * m[4]) - m[1] * (m[1] * z - m[4] * m[2]) + m[2] * (m[1] * m[4] - y * m[2]);
  const double cosine = std::clamp(0.5 * third / (size * size * size), -1.0, 1.0);
  const double angle = (std::acos(cosine) + 2 * std::numbers::pi) / 3;
  return std::max(least - (mean + 2 * size * std::cos(angle)), 0.0);
}
inline Lane lacking_support(const Lane (&m)[6], double least) {
  Lane lacking;
  for (int l = 0; l < lanes; ++l)
    lacking[l] = lacking_support({m[0][l], m[1][l], m[2][l], m[3][l], m[4][l], m[5][l]}, least);
  return lacking;
}

/// The same in three dimensions.
template <class Real> inline void invert_moment(const Real (&m)[6], Real (&inverse)[9]) {
  const Real shift = lacking_support(m, least_support);
  const Real a = m[0] + shift, d = m[3] + shift, f = m[5] + shift;
  const Real minor[6] = {d * f - m[4] * m[4], m[2] * m[4] - m[1] * f, m[1] * m[4] - m[2] * d,
                         a * f - m[2] * m[2], m[1] * m[2] - a * m[4], a * d - m[1] * m[1]};
  const Real scale = 1.0 / (a * minor[0] + m[1] * minor[1] + m[2] * minor[2]);
  constexpr int place[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int e = 0; e < 9; ++e) inverse[e] = minor[place[e]] * scale;
}

/// Fills `records.motion` of the particles (not of the images).
template <class Geometry> void show_motion(const Particles<Geometry>& particles, Records<Geometry>& records);

/// The same for particle i.
template <class Geometry>
inline void show_motion_of(const Particles<Geometry>& p, int i, Records<Geometry>& records) {
  auto& record = records.motion[i];
  for (int a = 0; a < Geometry::dimension; ++a) {
    record.position[a] = p.position[a][i];
    record.velocity[a] = p.velocity[a][i];
  }
  record.volume = p.mass[i] / (p.density[i] * Geometry::depth * Geometry::weight(p.position[0][i]));
}

/// Velocity gradient of the eight particles of cluster c, 1/s, component a * D + b, from `records.motion`.
template <class Geometry, int D>
inline void find_gradient(const Particles<Geometry>& p, const Kernel<D>& kernel, const NeighbourLists& lists,
                          const Records<Geometry>& records, int c, Lane (&gradient)[D * D]) {
  const int first = c * lanes;
  Lane position[D], velocity[D];
  for (int a = 0; a < D; ++a) {
    position[a] = load(&p.position[a][first]);
    velocity[a] = load(&p.velocity[a][first]);
  }
  GradientSums<D, Lane> sums;
  const int* neighbour = lists.begin(c);
  constexpr int ahead = 8; // their latencies overlap
  Lane w[ahead];
  for (int k = 0; k < lists.total[c]; k += ahead, neighbour += ahead) {
    const int n = std::min(ahead, lists.total[c] - k);
    for (int l = 0; l < n; ++l) w[l] = pair_weight(kernel, position, records.motion[neighbour[l]]);
    for (int l = 0; l < n; ++l) add_neighbour(w[l], position, velocity, records.motion[neighbour[l]], sums);
  }
  sums.scale(kernel.pair_scale());
  Lane inverse[D * D];
  invert_moment(sums.moment, inverse);
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) {
      Lane corrected{};
      for (int e = 0; e < D; ++e) corrected += sums.gradient[a * D + e] * inverse[e * D + b];
      gradient[a * D + b] = corrected;
    }
}

/// Velocity gradient of all particles.
template <class Geometry>
void update_gradient(Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                     const NeighbourLists& lists, const Records<Geometry>& records);

} // namespace host
