// SPDX-License-Identifier: BSD-3-Clause
// Particles sorted in space and one neighbour list for each cluster of eight. Lists reach beyond the support by a skin
// and are valid until a particle has moved half of it. Outer lists have a wide skin and take long to find; from these
// the lists that the pair loops read are pruned every few steps, with a narrow skin.
#pragma once
#include "host/walls/mirrors.hpp"

namespace host {

/// Record indices of the neighbours of each cluster: particles and images across the axis first, then
/// images behind walls. Entries of cluster c start at c * capacity.
struct NeighbourLists {
  int capacity = 64;
  std::vector<int> entries, interior, total; ///< the two counts are per cluster

  const int* begin(int cluster) const { return entries.data() + std::size_t(cluster) * capacity; }
};

/// Sorts the particles in space: in two dimensions along a Morton curve of cells of `cell`, m, in three by
/// bisection.
template <class Geometry> void sort_particles(Particles<Geometry>& particles, double cell);

/// Lists, for each cluster, all records within `reach` of one of its particles. Reads `records.motion`.
template <class Geometry>
void find_neighbours(const Particles<Geometry>& particles, const Images& images,
                     const Records<Geometry>& records, double reach, NeighbourLists& lists);

/// Copies from `outer`, in its order, the neighbours that are now within `reach` of one of the particles. A neighbour
/// beyond the support adds exactly zero to the sums of pairs, so that results do not depend on when lists are pruned.
template <class Geometry>
void prune(const Particles<Geometry>& particles, const Records<Geometry>& records, double reach,
           const NeighbourLists& outer, NeighbourLists& lists);

} // namespace host
