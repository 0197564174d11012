// SPDX-License-Identifier: BSD-3-Clause
// Room that motion among walls needs in a step, kept from step to step so that none is asked for.
#pragma once
#include "host/engine/integrate.hpp"
#include "host/walls/surfaces.hpp"

namespace host {

/// The push of wall images on one particle, taken apart (host/walls/wall_forces.hpp). Accelerations, m/s2.
template <int D> struct SplitPush {
  std::vector<Point<D>> by_surface; ///< one for each surface asked for
  Point<D> by_corners{};
};

/// The surfaces near one particle, and what each does to its velocity.
template <int D> struct Pushes {
  std::vector<const Surface<D>*> surface;
  std::vector<int> number;              ///< of the surface
  std::vector<double> distance, shares; ///< m; m/s along the normal
  std::vector<Point<D>> normal, change; ///< change of velocity, m/s
  SplitPush<D> split;
};

template <int D> struct WallRoom {
  std::vector<Surface<D>> ahead;     ///< the surfaces at the end of the step
  std::vector<Pushes<D>> pushes;     ///< one for each thread
  std::vector<ClusterMotion> motion; ///< one for each block of particles
  std::vector<WallLoad> load;        ///< one for each block and wall, the walls of a block side by side
};

} // namespace host
