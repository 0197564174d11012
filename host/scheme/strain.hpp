// SPDX-License-Identifier: BSD-3-Clause
// Strain increment dt sym(L) and rotation dt skew(L) of a particle over a step with the velocity gradient L.
#pragma once
#include "host/scheme/geometry.hpp"
#include <array>

namespace host {

template <class Geometry, class Real> struct StrainIncrement {
  std::array<Real, Geometry::stress_components> strain; ///< tension positive, in the order of the VUMAT
  /// Rotation vector, rad; in two dimensions its only component is the angle from axis 1 to axis 2.
  std::array<Real, Geometry::shear_components> angle;
};

/// Of a particle (or of eight) with the velocity gradient `gradient`, 1/s, component a * D + b, over `dt`, s; `r` and
/// `v_r` are its first coordinate, m, and velocity, m/s. The hoop strain rate is v_r / r, which is what the hoop force
/// works on. By symmetry, shear in the plane of axis and radius vanishes on the axis. A ring within a `spacing`, m, of the
/// axis therefore takes none: noise in this shear would load the rings at the axis with several times the stress around
/// them, until they burst.
template <class Geometry, class Real, std::size_t N>
inline StrainIncrement<Geometry, Real> strain_increment(const std::array<Real, N>& gradient, const Real& r,
                                                        const Real& v_r, double dt, double spacing) {
  constexpr int D = Geometry::dimension;
  const auto l = [&](int a, int b) { return gradient[a * D + b]; };
  const auto shear = [&](int a, int b) -> Real { return 0.5 * dt * (l(a, b) + l(b, a)); };
  const auto angle = [&](int a, int b) -> Real { return 0.5 * dt * (l(b, a) - l(a, b)); }; // from axis a to b
  if constexpr (D == 2) {
    Real hoop{}, in_plane = shear(0, 1);
    if constexpr (Geometry::hoop) {
      hoop = dt * v_r / r;
      in_plane = r < spacing ? Real{} : in_plane;
    }
    return {{l(0, 0) * dt, l(1, 1) * dt, hoop, in_plane}, {angle(0, 1)}};
  } else
    return {{l(0, 0) * dt, l(1, 1) * dt, l(2, 2) * dt, shear(0, 1), shear(1, 2), shear(2, 0)},
            {angle(1, 2), angle(2, 0), angle(0, 1)}};
}

} // namespace host
