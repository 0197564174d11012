// SPDX-License-Identifier: BSD-3-Clause
// Particles sorted in space and one neighbour list for each cluster of eight. Lists reach beyond the support by a skin
// and are valid until a particle has moved half of it. Outer lists have a wide skin and take long to find; from these
// the lists that the pair loops read are pruned every few steps, with a narrow skin.
#pragma once
#include "host/walls/images.hpp"

namespace host {

/// Record indices of the neighbours of each cluster: particles and images across planes of symmetry first, then images
/// behind walls, of which the last ones may be images that only some of its particles see (host/walls/sight.hpp).
/// Entries of cluster c start at c * capacity.
struct NeighbourLists {
  int capacity = 64;
  std::vector<int> entries{}, interior{}, total{}; ///< the two counts are per cluster
  std::vector<int> screened{}; ///< per cluster, how many images at the end not all particles see

  std::vector<int> screened_clusters{}; ///< those that have such images
  std::vector<int> sight_start{};       ///< per cluster, where its numbers begin in `sight`
  Array sight{}; ///< for each of those images and particles, 1 if the particle sees it, else 0

  const int* begin(int cluster) const { return entries.data() + std::size_t(cluster) * capacity; }
  /// Number of neighbours that all particles of the cluster have.
  int common(int cluster) const {
    return screened.empty() ? total[cluster] : total[cluster] - screened[cluster];
  }
  /// For neighbour number `n` of a cluster, from the first that is not common on: 1 for particles that see it, else 0.
  Lane sight_of(int cluster, int n) const {
    return load(&sight[sight_start[cluster] + std::size_t(n - common(cluster)) * lanes]);
  }
};

/// Sorts the particles in space: in two dimensions along a Morton curve of cells of `cell`, m, in three by
/// bisection.
template <class Geometry> void sort_particles(Particles<Geometry>& particles, double cell);

/// Lists, for each cluster, all records within `reach` of one of its particles. Images in shells are screened for those
/// clusters that `may_be_screened` says it of (none if it is empty). Reads `records.motion`.
template <class Geometry>
void find_neighbours(const Particles<Geometry>& particles, const Images& images,
                     const Records<Geometry>& records, double reach, NeighbourLists& lists,
                     const std::vector<char>& may_be_screened = {});

/// Copies from `outer`, in its order, the neighbours that are now within `reach` of one of the particles. A neighbour
/// beyond the support adds exactly zero to the sums of pairs, so that results do not depend on when lists are pruned.
template <class Geometry>
void prune(const Particles<Geometry>& particles, const Records<Geometry>& records, double reach,
           const NeighbourLists& outer, NeighbourLists& lists);

} // namespace host
