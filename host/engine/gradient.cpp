// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/gradient.hpp"
#include "host/scheme/geometry.hpp"

namespace host {

template <class Geometry> void show_motion(const Particles<Geometry>& p, Records<Geometry>& records) {
#pragma omp parallel for schedule(static)
  for (int i = 0; i < p.count; ++i) show_motion_of(p, i, records);
}

template <class Geometry>
void update_gradient(Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                     const NeighbourLists& lists, const Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
#pragma omp parallel for schedule(static)
  for (int c = 0; c < p.clusters(); ++c) {
    Lane gradient[D * D];
    find_gradient(p, kernel, lists, records, c, gradient);
    for (int e = 0; e < D * D; ++e) store(&p.velocity_gradient[e][c * lanes], gradient[e]);
  }
}

template void show_motion(const Particles<PlaneStrain>&, Records<PlaneStrain>&);
template void show_motion(const Particles<Axisymmetric>&, Records<Axisymmetric>&);
template void show_motion(const Particles<ThreeDimensional>&, Records<ThreeDimensional>&);
template void update_gradient(Particles<PlaneStrain>&, const Kernel<2>&, const NeighbourLists&,
                              const Records<PlaneStrain>&);
template void update_gradient(Particles<Axisymmetric>&, const Kernel<2>&, const NeighbourLists&,
                              const Records<Axisymmetric>&);
template void update_gradient(Particles<ThreeDimensional>&, const Kernel<3>&, const NeighbourLists&,
                              const Records<ThreeDimensional>&);

} // namespace host
