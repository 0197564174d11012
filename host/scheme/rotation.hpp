// SPDX-License-Identifier: BSD-3-Clause
// What a step does to a particle as its velocity gradient L says: the strain increment dt sym(L) and the
// rotation exp(dt skew(L)), which turns the old stress exactly, whatever the angle.
#pragma once
#include "host/scheme/geometry.hpp"
#include "host/scheme/lane.hpp"
#include <array>
#include <cmath>

namespace host {

/// Strain increment in the order of the VUMAT, and the rotation vector, rad: in two dimensions its only
/// component is the angle from axis 1 to axis 2.
template <class Geometry, class Real> struct StepStrain {
  std::array<Real, Geometry::stress_components> strain;
  std::array<Real, Geometry::shear_components> angle;
};

/// Of a particle (or of eight) whose gradient is `gradient`, 1/s; `r` and `v_r` are its first coordinate and
/// velocity. The hoop strain rate is v_r / r, which is what the hoop force works on. By symmetry shear in the plane of
/// the axis and its radius vanishes on the axis, and so does the stress it makes: the ring within a spacing of the axis
/// takes none. With it, noise there loads a pillar of several times the stress around it, which may burst.
template <class Geometry, class Real, std::size_t N>
inline StepStrain<Geometry, Real> step_strain(const std::array<Real, N>& gradient, const Real& r,
                                              const Real& v_r, double dt, double spacing) {
  constexpr int D = Geometry::dimension;
  const auto l = [&](int a, int b) { return gradient[a * D + b]; };
  const auto shear = [&](int a, int b) -> Real { return 0.5 * dt * (l(a, b) + l(b, a)); };
  const auto turn = [&](int a, int b) -> Real { return 0.5 * dt * (l(b, a) - l(a, b)); }; // from axis a to b
  if constexpr (D == 2) {
    Real hoop{}, in_plane = shear(0, 1);
    if constexpr (Geometry::hoop) {
      hoop = dt * v_r / r;
      in_plane = r < spacing ? Real{} : in_plane;
    }
    return {{l(0, 0) * dt, l(1, 1) * dt, hoop, in_plane}, {turn(0, 1)}};
  } else
    return {{l(0, 0) * dt, l(1, 1) * dt, l(2, 2) * dt, shear(0, 1), shear(1, 2), shear(2, 0)},
            {turn(1, 2), turn(2, 0), turn(0, 1)}};
}

/// sin(t)/t and (1 - cos(t))/t2 of t2 = t squared. Below 0.1 rad both are series, exact to rounding.
template <class Real> inline std::array<Real, 2> turning(const Real& t2) {
  if (!(largest(t2) < 0.01)) {
    const auto sine = [](double x) {
      return x < 0.01 ? turning(x)[0] : std::sin(std::sqrt(x)) / std::sqrt(x);
    };
    const auto cosine = [](double x) { return x < 0.01 ? turning(x)[1] : (1 - std::cos(std::sqrt(x))) / x; };
    return {each(t2, sine), each(t2, cosine)};
  }
  return {1 - t2 / 6 * (1 - t2 / 20 * (1 - t2 / 42 * (1 - t2 / 72))),
          0.5 - t2 / 24 * (1 - t2 / 30 * (1 - t2 / 56 * (1 - t2 / 90)))};
}

/// In-plane tensor (11, 22, 33, 12) turned by `angle` from axis 1 to axis 2.
template <class Real>
inline std::array<Real, 4> turned(const std::array<Real, 4>& s, const std::array<Real, 1>& angle) {
  const Real twice = 2 * angle[0];
  const auto [a, b] = turning<Real>(twice * twice);
  const Real cosine = 1 - b * twice * twice, sine = a * twice;
  const Real mean = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
  const Real turned_half = half * cosine - s[3] * sine;
  return {mean + turned_half, mean - turned_half, s[2], half * sine + s[3] * cosine};
}

/// Rotation matrix, row by row, of the rotation vector w (Rodrigues): 1 + a W + b W2 with W x = w cross x,
/// a = sin(t)/t, b = (1 - cos(t))/t2, t = |w|.
template <class Real> inline std::array<Real, 9> rotation_matrix(const std::array<Real, 3>& w) {
  const Real t2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  const auto [a, b] = turning(t2);
  const Real c = 1 - b * t2;
  return {c + b * w[0] * w[0],        b * w[0] * w[1] - a * w[2], b * w[0] * w[2] + a * w[1],
          b * w[0] * w[1] + a * w[2], c + b * w[1] * w[1],        b * w[1] * w[2] - a * w[0],
          b * w[0] * w[2] - a * w[1], b * w[1] * w[2] + a * w[0], c + b * w[2] * w[2]};
}

/// R s R^T of a symmetric tensor (11, 22, 33, 12, 23, 31), R the rotation of the vector `angle`.
template <class Real>
inline std::array<Real, 6> turned(const std::array<Real, 6>& s, const std::array<Real, 3>& angle) {
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
