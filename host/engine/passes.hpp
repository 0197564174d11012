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

/// Memory for the results of blocks of particles and for the threads, kept so that a step allocates none.
template <int D> struct MotionBuffers {
  std::vector<Motion> motion;         ///< one for each block of particles
  std::vector<WallLoad> loads;        ///< one for each block and wall, the walls of a block side by side
  std::vector<PushBuffer<D>> threads; ///< one for each
};

/// Forces, velocities and positions of all particles, from both records; stress diffuses. Adds the loads of the walls.
/// Returns the sum of the blocks' motion in their order, the same for any number of threads.
template <class Geometry>
Motion move(Particles<Geometry>& particles, const Medium& medium, const MotionTerms<Geometry>& terms,
            MotionBuffers<Geometry::dimension>& buffers, std::vector<WallLoad>& loads);

} // namespace host
