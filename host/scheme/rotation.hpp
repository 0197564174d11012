// SPDX-License-Identifier: BSD-3-Clause
// Rotation of stress with the material over a step: exp(dt skew(L)) of the velocity gradient L turns the old stress
// exactly, whatever the angle.
#pragma once
#include "host/scheme/geometry.hpp"
#include "host/scheme/lane.hpp"
#include <array>
#include <cmath>

namespace host {

/// sin(t)/t and (1 - cos(t))/t2, where t2 is the square of the angle t, rad2. Below 0.1 rad both are series, exact to
/// rounding.
template <class Real> inline std::array<Real, 2> rotation_coefficients(const Real& t2) {
  if (!(largest(t2) < 0.01)) {
    const auto sine = [](double x) {
      return x < 0.01 ? rotation_coefficients(x)[0] : std::sin(std::sqrt(x)) / std::sqrt(x);
    };
    const auto cosine = [](double x) {
      return x < 0.01 ? rotation_coefficients(x)[1] : (1 - std::cos(std::sqrt(x))) / x;
    };
    return {each(t2, sine), each(t2, cosine)};
  }
  return {1 - t2 / 6 * (1 - t2 / 20 * (1 - t2 / 42 * (1 - t2 / 72))),
          0.5 - t2 / 24 * (1 - t2 / 30 * (1 - t2 / 56 * (1 - t2 / 90)))};
}

/// Tensor in the plane (11, 22, 33, 12) rotated by `angle`, rad, from axis 1 to axis 2.
template <class Real>
inline std::array<Real, 4> rotated(const std::array<Real, 4>& s, const std::array<Real, 1>& angle) {
  const Real twice = 2 * angle[0];
  const auto [a, b] = rotation_coefficients<Real>(twice * twice);
  const Real cosine = 1 - b * twice * twice, sine = a * twice;
  const Real mean = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
  const Real rotated_half = half * cosine - s[3] * sine;
  return {mean + rotated_half, mean - rotated_half, s[2], half * sine + s[3] * cosine};
}

/// Rotation matrix, row by row, of the rotation vector w (Rodrigues): 1 + a W + b W2 with W x = w cross x,
/// a = sin(t)/t, b = (1 - cos(t))/t2, t = |w|.
template <class Real> inline std::array<Real, 9> rotation_matrix(const std::array<Real, 3>& w) {
  const Real t2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  const auto [a, b] = rotation_coefficients(t2);
  const Real c = 1 - b * t2;
  return {c + b * w[0] * w[0],        b * w[0] * w[1] - a * w[2], b * w[0] * w[2] + a * w[1],
          b * w[0] * w[1] + a * w[2], c + b * w[1] * w[1],        b * w[1] * w[2] - a * w[0],
          b * w[0] * w[2] - a * w[1], b * w[1] * w[2] + a * w[0], c + b * w[2] * w[2]};
}

/// R s R^T of a symmetric tensor (11, 22, 33, 12, 23, 31), R the rotation by the vector `angle`, rad.
template <class Real>
inline std::array<Real, 6> rotated(const std::array<Real, 6>& s, const std::array<Real, 3>& angle) {
  const auto r = rotation_matrix(angle);
  Real half[9]; // R s
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      half[3 * a + b] = Real{};
      for (int e = 0; e < 3; ++e) half[3 * a + b] += r[3 * a + e] * s[component<3>(e, b)];
    }
  const auto entry = [&](int a, int b) -> Real {
    return half[3 * a] * r[3 * b] + half[3 * a + 1] * r[3 * b + 1] + half[3 * a + 2] * r[3 * b + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

} // namespace host
