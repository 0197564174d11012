// SPDX-License-Identifier: BSD-3-Clause
// What a step does to a particle as its velocity gradient L says: the strain increment dt sym(L) and the
// rotation exp(dt skew(L)), which turns the old stress exactly, whatever the angle.
#pragma once
#include "host/geometry.hpp"
#include "host/particles.hpp"
#include <cmath>

namespace host {

/// Strain increment in the order of the VUMAT, and the rotation vector, rad: in two dimensions its only
/// component is the angle from axis 1 to axis 2.
template <class Geometry> struct StepStrain {
  std::array<double, Geometry::stress_components> strain;
  std::array<double, Geometry::shear_components> angle;
};

/// Hoop strain rate v_r / r. Within a spacing of the axis it is d v_r / d r, which is the same where a flow is
/// regular: there v_r / r turns each jitter of the innermost ring into strain, and its stress would grow
/// to many times that of its neighbours during a collapse.
template <class Geometry> double hoop_rate(const Particles<Geometry>& p, int i, double spacing) {
  if (!Geometry::hoop) return 0;
  return p.position[0][i] < spacing ? p.velocity_gradient[0][i] : p.velocity[0][i] / p.position[0][i];
}

/// Shear rate in the plane of the axis and its radius. By symmetry it vanishes on the axis, and so does the stress it
/// makes: the ring within a spacing of the axis takes none. With it, noise there loads a pillar of several times
/// the stress around it, which may burst.
template <class Geometry> bool sheared(const Particles<Geometry>& p, int i, double spacing) {
  return !Geometry::hoop || p.position[0][i] >= spacing;
}

template <class Geometry>
StepStrain<Geometry> step_strain(const Particles<Geometry>& p, int i, double dt, double spacing) {
  constexpr int D = Geometry::dimension;
  const auto l = [&](int a, int b) { return p.velocity_gradient[a * D + b][i]; };
  const auto shear = [&](int a, int b) { return 0.5 * (l(a, b) + l(b, a)) * dt; };
  const auto turn = [&](int a, int b) { return 0.5 * (l(b, a) - l(a, b)) * dt; }; // from axis a to axis b
  if constexpr (D == 2)
    return {
        {l(0, 0) * dt, l(1, 1) * dt, hoop_rate(p, i, spacing) * dt, sheared(p, i, spacing) ? shear(0, 1) : 0},
        {turn(0, 1)}};
  else
    return {{l(0, 0) * dt, l(1, 1) * dt, l(2, 2) * dt, shear(0, 1), shear(1, 2), shear(2, 0)},
            {turn(1, 2), turn(2, 0), turn(0, 1)}};
}

/// In-plane tensor (11, 22, 33, 12) turned by `angle` from axis 1 to axis 2.
inline std::array<double, 4> turned(const std::array<double, 4>& s, const std::array<double, 1>& angle) {
  const double cosine = std::cos(2 * angle[0]), sine = std::sin(2 * angle[0]);
  const double mean = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
  const double turned_half = half * cosine - s[3] * sine;
  return {mean + turned_half, mean - turned_half, s[2], half * sine + s[3] * cosine};
}

/// Rotation matrix, row by row, of the rotation vector w (Rodrigues): 1 + a W + b W2 with W x = w cross x,
/// a = sin(t)/t, b = (1 - cos(t))/t2, t = |w|. Below 0.1 rad both are series, exact to rounding.
inline std::array<double, 9> rotation_matrix(const std::array<double, 3>& w) {
  const double t2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  double a, b;
  if (t2 < 0.01) {
    a = 1 - t2 / 6 * (1 - t2 / 20 * (1 - t2 / 42 * (1 - t2 / 72)));
    b = 0.5 - t2 / 24 * (1 - t2 / 30 * (1 - t2 / 56 * (1 - t2 / 90)));
  } else {
    const double t = std::sqrt(t2);
    a = std::sin(t) / t;
    b = (1 - std::cos(t)) / t2;
  }
  const double c = 1 - b * t2;
  return {c + b * w[0] * w[0],        b * w[0] * w[1] - a * w[2], b * w[0] * w[2] + a * w[1],
          b * w[0] * w[1] + a * w[2], c + b * w[1] * w[1],        b * w[1] * w[2] - a * w[0],
          b * w[0] * w[2] - a * w[1], b * w[1] * w[2] + a * w[0], c + b * w[2] * w[2]};
}

/// R s R^T of a symmetric tensor (11, 22, 33, 12, 23, 31), R the rotation of the vector `angle`.
inline std::array<double, 6> turned(const std::array<double, 6>& s, const std::array<double, 3>& angle) {
  const auto r = rotation_matrix(angle);
  double half[9]; // R s
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      half[3 * a + b] = 0;
      for (int e = 0; e < 3; ++e) half[3 * a + b] += r[3 * a + e] * s[component<3>(e, b)];
    }
  const auto entry = [&](int a, int b) {
    return half[3 * a] * r[3 * b] + half[3 * a + 1] * r[3 * b + 1] + half[3 * a + 2] * r[3 * b + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

} // namespace host
