// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/gradient.hpp"
#include "host/scheme/geometry.hpp"

namespace host {

template <class Geometry> void show_motion(const Particles<Geometry>& p, Records<Geometry>& records) {
#pragma omp parallel for schedule(static)
  for (int i = 0; i < p.count; ++i) show_motion_of(p, i, records);
}

template decltype(show_motion<PlaneStrain>) show_motion<PlaneStrain>;
template decltype(show_motion<Axisymmetric>) show_motion<Axisymmetric>;
template decltype(show_motion<ThreeDimensional>) show_motion<ThreeDimensional>;

} // namespace host
