// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/momentum.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>

namespace host {
namespace {

/// The eight particles of a cluster, from their records; padding repeats the last particle.
template <class Geometry>
PairSide<Geometry, Lane> gather_cluster(const Records<Geometry>& records, int first, int used) {
  constexpr int D = Geometry::dimension;
  PairSide<Geometry, Lane> side;
  for (int l = 0; l < lanes; ++l) {
    const auto& m = records.motion[first + std::min(l, used - 1)];
    const auto& r = records.stress[first + std::min(l, used - 1)];
    for (int a = 0; a < D; ++a) {
      side.position[a][l] = m.position[a];
      side.velocity[a][l] = m.velocity[a];
    }
    side.weight[l] = Geometry::weight(m.position[0]);
    side.radius[l] = float(m.position[0]);
    side.density[l] = r.density;
    side.damping_speed[l] = r.damping_speed;
    for (int c = 0; c < D * (D + 1) / 2; ++c) side.strain_rate[c][l] = r.strain_rate[c];
  }
  return side;
}

/// Adds `count` neighbours and multiplies the sums by the kernel's scale.
template <bool diffuses, class Geometry, int D>
void add_pairs(const Kernel<D>& kernel, const PairSide<Geometry, Lane>& i, const Records<Geometry>& records,
               const int* neighbour, int count, PairSums<Geometry, Lane>& sums) {
  constexpr int ahead = 8; // pairs at a time, so that their square roots and divisions overlap
  PairFactors<Lane> factors[ahead];
  for (int first = 0; first < count; first += ahead, neighbour += ahead) {
    const int n = std::min(ahead, count - first);
    for (int k = 0; k < n; ++k)
      factors[k] = pair_factors(kernel, i, records.motion[neighbour[k]], records.stress[neighbour[k]]);
    for (int k = 0; k < n; ++k)
      add_pair<diffuses>(factors[k], i, records.motion[neighbour[k]], records.stress[neighbour[k]], sums);
  }
}

/// Adds the images of cluster `c` that only some of its particles see.
template <class Geometry, int D>
void add_screened_images(const Kernel<D>& kernel, const PairSide<Geometry, Lane>& i,
                         const Records<Geometry>& records, const NeighbourLists& lists, int c,
                         PairSums<Geometry, Lane>& sums) {
  for (int k = lists.common(c); k < lists.total[c]; ++k) {
    const int j = lists.begin(c)[k];
    auto factors = pair_factors(kernel, i, records.motion[j], records.stress[j]);
    factors.shape *= lists.sight_of(c, k);
    add_pair<false>(factors, i, records.motion[j], records.stress[j], sums);
  }
}

} // namespace

template <class Geometry>
ClusterForces<Geometry> forces_on(const Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                                  const NeighbourLists& lists, const Records<Geometry>& records,
                                  const Medium& medium, int c) {
  constexpr int S = Geometry::stress_components;
  const int first = c * lanes;
  const auto i = gather_cluster(records, first, std::min(lanes, p.count - first));
  PairSums<Geometry, Lane> inside, wall;
  const int* neighbour = lists.begin(c);
  add_pairs<true>(kernel, i, records, neighbour, lists.interior[c], inside);
  add_pairs<false>(kernel, i, records, neighbour + lists.interior[c], lists.common(c) - lists.interior[c],
                   wall);
  add_screened_images(kernel, i, records, lists, c, wall);
  inside.scale(kernel.pair_scale());
  wall.scale(kernel.pair_scale());
  OwnStress<Geometry, Lane> own;
  for (int s = 0; s < S; ++s) own.stress[s] = load(&p.stress[s][first]);
  own.inverse_weight = 1.0 / i.weight;
  own.inverse_density = 1.0 / load(&p.density[first]);
  const auto by_pairs = finish_pairs(own, inside, kernel.h);
  return {by_pairs.stress, by_pairs.viscous, finish_images(own, wall, kernel.h),
          diffusion_rate(own, inside, load(&p.diffusivity[first]), medium)};
}

template decltype(forces_on<PlaneStrain>) forces_on<PlaneStrain>;
template decltype(forces_on<Axisymmetric>) forces_on<Axisymmetric>;
template decltype(forces_on<ThreeDimensional>) forces_on<ThreeDimensional>;

} // namespace host
