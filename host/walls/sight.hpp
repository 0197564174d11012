// SPDX-License-Identifier: BSD-3-Clause
// Which particles an image in a shell acts on. A shell has no thickness and ends, so that sand may be on both sides
// of it. A particle sees an image in it if the straight line from one to the other goes through the shell, as light
// would: not from the image's own side, and not past the edge.
#pragma once
#include "host/engine/neighbours.hpp"
#include "host/walls/surface.hpp"

namespace host {

/// For each cluster whether a particle of it may have, until the lists are renewed, images in a shell in its
/// neighbourhood that it does not see. `reach` and `skin` are those of the lists, m.
template <class Geometry>
std::vector<char> find_screened_clusters(const Particles<Geometry>& particles,
                                         const std::vector<Surface<Geometry::dimension>>& surfaces,
                                         const Images& images, double reach, double skin);

/// Fills `lists.sight`: of each neighbour that is an image in a shell, near an edge or on the other side, 1 for the
/// particles of the cluster that see it and 0 for the others. Reads `records.motion`.
template <class Geometry>
void find_sight(const Particles<Geometry>& particles,
                const std::vector<Surface<Geometry::dimension>>& surfaces, const Images& images,
                const Records<Geometry>& records, NeighbourLists& lists);

} // namespace host
