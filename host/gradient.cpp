// SPDX-License-Identifier: BSD-3-Clause
#include "host/gradient.hpp"
#include "host/geometry.hpp"

namespace host {

template <class Geometry> void show_motion(const Particles<Geometry>& p, Records<Geometry>& records) {
#pragma omp parallel for schedule(static)
  for (int i = 0; i < p.count; ++i) {
    auto& record = records.motion[i];
    for (int a = 0; a < Geometry::dimension; ++a) {
      record.position[a] = p.position[a][i];
      record.velocity[a] = p.velocity[a][i];
    }
    record.volume = p.mass[i] / (p.density[i] * Geometry::depth * Geometry::weight(p.position[0][i]));
  }
}

template <class Geometry>
void update_gradient(Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                     const NeighbourLists& lists, const Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
#pragma omp parallel for schedule(static)
  for (int c = 0; c < p.clusters(); ++c) {
    const int first = c * lanes;
    Lane position[D], velocity[D];
    for (int a = 0; a < D; ++a) {
      position[a] = load(&p.position[a][first]);
      velocity[a] = load(&p.velocity[a][first]);
    }
    GradientSums<D, Lane> sums;
    const int* neighbour = lists.begin(c);
    for (int k = 0; k < lists.total[c]; ++k)
      add_neighbour(kernel, position, velocity, records.motion[neighbour[k]], sums);
    Lane inverse[D * D];
    invert_moment(sums.moment, inverse);
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) {
        Lane corrected{};
        for (int e = 0; e < D; ++e) corrected += sums.gradient[a * D + e] * inverse[e * D + b];
        store(&p.velocity_gradient[a * D + b][first], corrected);
      }
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
