// SPDX-License-Identifier: BSD-3-Clause
// The moment matrix of a particle, M = sum_j V_j (x_j - x_i) (x) grad W_ij, which is the unit matrix where neighbours
// surround it, and its inverse, which makes the velocity gradient exact for linear fields.
#pragma once
#include "host/scheme/lane.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace host {

/// The smallest eigenvalue that is accepted. A complete support has 1, particles of the surface layer about one half;
/// one without neighbours has 0, and its matrix has no inverse. Where the smallest eigenvalue is below this bound, a
/// multiple of the unit matrix is added that brings it there.
inline constexpr double least_support = 0.25;

/// Inverse of the moment matrix with that shift, in two dimensions; `m` is the upper triangle, row by row.
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

/// By how much the smallest eigenvalue of a symmetric matrix (upper triangle) is below `least`; 0 if it is not.
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

/// Inverse of the moment matrix with that shift, in three dimensions.
template <class Real> inline void invert_moment(const Real (&m)[6], Real (&inverse)[9]) {
  const Real shift = lacking_support(m, least_support);
  const Real a = m[0] + shift, d = m[3] + shift, f = m[5] + shift;
  const Real minor[6] = {d * f - m[4] * m[4], m[2] * m[4] - m[1] * f, m[1] * m[4] - m[2] * d,
                         a * f - m[2] * m[2], m[1] * m[2] - a * m[4], a * d - m[1] * m[1]};
  const Real scale = 1.0 / (a * minor[0] + m[1] * minor[1] + m[2] * minor[2]);
  constexpr int place[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int e = 0; e < 9; ++e) inverse[e] = minor[place[e]] * scale;
}

} // namespace host
