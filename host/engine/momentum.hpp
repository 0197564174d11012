// SPDX-License-Identifier: BSD-3-Clause
// The forces on a cluster of particles, by its neighbour list; the sums are in host/scheme/pair.hpp and forces.hpp.
#pragma once
#include "host/engine/neighbours.hpp"
#include "host/scheme/forces.hpp"

namespace host {

/// Accelerations of the particles of one cluster by stress, viscosity and walls, m/s2, and the rate of stress diffusion,
/// Pa/s. Gravity and friction are not in them.
template <class Geometry> struct ClusterForces {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  std::array<Lane, D> stress, viscous, wall;
  std::array<Lane, S> diffusion;
};

/// Forces on cluster c, from both records.
template <class Geometry>
ClusterForces<Geometry> forces_on(const Particles<Geometry>& particles,
                                  const Kernel<Geometry::dimension>& kernel, const NeighbourLists& lists,
                                  const Records<Geometry>& records, const Medium& medium, int c);

} // namespace host
