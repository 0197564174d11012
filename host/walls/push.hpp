// SPDX-License-Identifier: BSD-3-Clause
// The push of wall images on a particle, and the friction that goes with it. The pair sums hold the images of all walls
// together; near several surfaces they are taken apart: images in one surface push for that surface, though not only
// across it (they carry stress along the wall as the sand does, with a sum of zero over the wall); images of images,
// which fill corners, push for all.
#pragma once
#include "host/engine/neighbours.hpp"
#include "host/scheme/forces.hpp"
#include "host/walls/near_walls.hpp"

namespace host {

/// The pairs of a step, with the images of walls among them.
template <class Geometry> struct PairsOfStep {
  const Kernel<Geometry::dimension>& kernel;
  const NeighbourLists& lists;
  const Records<Geometry>& records;
  const Images& images;
};

/// Memory that one thread needs for one particle, kept so that none is allocated in a step.
template <int D> struct PushBuffer {
  std::vector<NearSurface<D>> near;
  std::vector<double> shares;
};

/// Acceleration of particle `i` of density `density` by the images of single surfaces, added to the `push` of each
/// of `near`. Returns that by all others.
template <class Geometry, int D = Geometry::dimension>
Vector<D> separate_push(const PairsOfStep<Geometry>& pairs, int i, double density,
                        std::vector<NearSurface<D>>& near);

/// Changes the velocity of particle number `i`, which holds that of the other forces, by the `push` of images, m/s, and
/// by friction. No wall pulls: what a surface would take from the velocity along its normal is left out. Adds the
/// work of both.
template <class Geometry, int D = Geometry::dimension>
void push_by_walls(const PairsOfStep<Geometry>& pairs, const WallsOfStep<D>& walls, int i, double density,
                   const Vector<D>& push, double kick_time, MovingParticle<D>& particle,
                   PushBuffer<D>& buffer);

} // namespace host
