// SPDX-License-Identifier: BSD-3-Clause
// The velocity gradient of a cluster of particles, by its neighbour list; the sums are in host/scheme/gradient.hpp.
#pragma once
#include "host/engine/neighbours.hpp"
#include "host/scheme/gradient.hpp"
#include <algorithm>

namespace host {

/// Fills `records.motion` of the particles (not of the images).
template <class Geometry> void show_motion(const Particles<Geometry>& particles, Records<Geometry>& records);

/// Writes `records.motion` of particle i.
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
  const int common = lists.common(c);
  constexpr int ahead = 8; // pairs at a time, so that their square roots overlap
  Lane shape[ahead];
  for (int k = 0; k < common; k += ahead, neighbour += ahead) {
    const int n = std::min(ahead, common - k);
    for (int l = 0; l < n; ++l) shape[l] = pair_shape(kernel, position, records.motion[neighbour[l]]);
    for (int l = 0; l < n; ++l)
      add_neighbour(shape[l], position, velocity, records.motion[neighbour[l]], sums);
  }
  for (int k = common; k < lists.total[c]; ++k) {
    const auto& image = records.motion[lists.begin(c)[k]];
    add_neighbour(lists.sight_of(c, k) * pair_shape(kernel, position, image), position, velocity, image,
                  sums);
  }
  sums.scale(kernel.pair_scale());
  correct_gradient(sums, gradient);
}

} // namespace host
