// SPDX-License-Identifier: BSD-3-Clause
// The two passes of a step over all particles. What concerns a particle and needs nothing of this step from its
// neighbours is done at once, while its numbers are at hand: threads meet twice a step, and what passes from one
// stage to the next is kept for one block of particles, not for all.
#pragma once
#include "host/engine/integrate.hpp"
#include "host/engine/stress.hpp"

namespace host {

/// Velocity gradient, stress and `records.stress` of all particles, from `records.motion`. Throws as check_strain does,
/// and std::runtime_error with particle, time, stress and strain increment if the material returns a number that is not
/// finite or reports a failure. Returns the largest component of all gradients, 1/s.
template <class Geometry>
double deform(Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
              const NeighbourLists& lists, const Medium& medium, const Material& material,
              const Increment& increment, StressBlocks& blocks, Records<Geometry>& records);

/// Forces, velocities and positions of all particles, from both records; stress diffuses. `motions` is room for
/// the results of blocks. Returns their sum in the order of the blocks, the same for any number of threads.
template <class Geometry>
ClusterMotion move(Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                   const NeighbourLists& lists, const Scene& scene, const std::vector<Mirror>& mirrors,
                   double dt_before, double dt, const Records<Geometry>& records,
                   std::vector<ClusterMotion>& motions);

} // namespace host
