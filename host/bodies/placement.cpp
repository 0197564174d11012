// SPDX-License-Identifier: BSD-3-Clause
#include "host/bodies/placement.hpp"
#include "host/scheme/geometry.hpp"
#include <cmath>

namespace host {

template <class Geometry> void place(const Column& column, Particles<Geometry>& p) {
  constexpr int up = Geometry::dimension - 1, shear = Geometry::dimension == 2 ? 3 : 5; // of x and z
  const double angle = column.tilt * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  for (int i = 0; i < p.count; ++i) {
    const double along = p.position[0][i], above = p.position[up][i];
    p.position[0][i] = column.center[0] + c * along - s * above;
    if (up == 2) p.position[1][i] += column.center[1];
    p.position[up][i] = column.base + s * along + c * above;
    for (auto& component : p.stress) component[i] *= c; // gravity across the layer
    const double t = p.stress[0][i], n = p.stress[up][i];
    p.stress[0][i] = c * c * t + s * s * n;
    p.stress[up][i] = s * s * t + c * c * n;
    p.stress[shear][i] = c * s * (t - n);
  }
}

template decltype(place<PlaneStrain>) place<PlaneStrain>;
template decltype(place<Axisymmetric>) place<Axisymmetric>;
template decltype(place<ThreeDimensional>) place<ThreeDimensional>;

} // namespace host
