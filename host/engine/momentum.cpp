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

/// w_i sigma_i sum g + sum w_j sigma_j g, over the weight.
template <class Geometry, int D, int S>
void stress_force(const Lane (&stress)[S], const Lane& inverse_weight, const PairSums<Geometry, Lane>& sums,
                  Lane (&force)[D]) {
  for (int a = 0; a < D; ++a) {
    force[a] = sums.stress_force[a];
    if constexpr (Geometry::hoop) force[a] *= inverse_weight;
    for (int b = 0; b < D; ++b) force[a] += stress[component<D>(a, b)] * sums.slope[b];
  }
}

/// Adds `count` neighbours.
template <bool diffuses, class Geometry, int D>
void add_pairs(const Kernel<D>& kernel, const PairSide<Geometry, Lane>& i, const Records<Geometry>& records,
               const int* neighbour, int count, PairSums<Geometry, Lane>& sums) {
  constexpr int ahead = 8;
  PairFactors<Lane> factors[ahead];
  for (int first = 0; first < count; first += ahead, neighbour += ahead) {
    const int n = std::min(ahead, count - first);
    for (int k = 0; k < n; ++k)
      factors[k] = pair_factors(kernel, i, records.motion[neighbour[k]], records.stress[neighbour[k]]);
    for (int k = 0; k < n; ++k)
      add_pair<diffuses>(factors[k], i, records.motion[neighbour[k]], records.stress[neighbour[k]], sums);
  }
  sums.scale(kernel.pair_scale());
}

} // namespace

template <class Geometry>
ClusterForces<Geometry> forces_on(const Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                                  const NeighbourLists& lists, const Records<Geometry>& records,
                                  const Scene& scene, int c) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  const int first = c * lanes;
  const auto i = gather_cluster(records, first, std::min(lanes, p.count - first));
  PairSums<Geometry, Lane> inside, wall;
  const int* neighbour = lists.begin(c);
  add_pairs<true>(kernel, i, records, neighbour, lists.interior[c], inside);
  add_pairs<false>(kernel, i, records, neighbour + lists.interior[c], lists.total[c] - lists.interior[c],
                   wall);
  Lane stress[S], by_stress[D], by_walls[D];
  for (int s = 0; s < S; ++s) stress[s] = load(&p.stress[s][first]);
  const Lane inverse_weight = 1.0 / i.weight, inverse_density = 1.0 / load(&p.density[first]);
  stress_force(stress, inverse_weight, inside, by_stress);
  stress_force(stress, inverse_weight, wall, by_walls);
  if constexpr (Geometry::hoop) by_stress[0] -= stress[2] * inverse_weight;
  Lane damping = (0.25 * kernel.h) * inverse_density;
  if constexpr (Geometry::hoop) damping *= 0.5 * inverse_weight;
  ClusterForces<Geometry> forces;
  for (int a = 0; a < D; ++a) {
    forces.stress[a] = by_stress[a] * inverse_density;
    forces.viscous[a] = inside.viscous[a] * damping;
    forces.wall[a] = by_walls[a] * inverse_density + wall.viscous[a] * damping;
  }
  const double weight_gradient = scene.bulk_density * scene.gravity;
  const Lane twice_diffusivity = 2 * load(&p.diffusivity[first]);
  for (int s = 0; s < S; ++s) {
    Lane rate = stress[s] * inside.weight - inside.stress[s];
    if (s < 3) rate -= (s == D - 1 ? 1 : scene.earth_pressure_ratio) * weight_gradient * inside.slope[D - 1];
    forces.diffusion[s] = rate * twice_diffusivity;
  }
  return forces;
}

template <class Geometry>
void update_acceleration(Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                         const NeighbourLists& lists, const Records<Geometry>& records, const Scene& scene) {
#pragma omp parallel for schedule(static)
  for (int c = 0; c < p.clusters(); ++c) {
    const auto forces = forces_on(p, kernel, lists, records, scene, c);
    for (int a = 0; a < Geometry::dimension; ++a) {
      store(&p.stress_acceleration[a][c * lanes], forces.stress[a]);
      store(&p.viscous_acceleration[a][c * lanes], forces.viscous[a]);
      store(&p.wall_acceleration[a][c * lanes], forces.wall[a]);
    }
    for (int s = 0; s < Geometry::stress_components; ++s)
      store(&p.stress_diffusion[s][c * lanes], forces.diffusion[s]);
  }
}

template ClusterForces<PlaneStrain> forces_on(const Particles<PlaneStrain>&, const Kernel<2>&,
                                              const NeighbourLists&, const Records<PlaneStrain>&,
                                              const Scene&, int);
template void update_acceleration(Particles<PlaneStrain>&, const Kernel<2>&, const NeighbourLists&,
                                  const Records<PlaneStrain>&, const Scene&);
template ClusterForces<Axisymmetric> forces_on(const Particles<Axisymmetric>&, const Kernel<2>&,
                                               const NeighbourLists&, const Records<Axisymmetric>&,
                                               const Scene&, int);
template void update_acceleration(Particles<Axisymmetric>&, const Kernel<2>&, const NeighbourLists&,
                                  const Records<Axisymmetric>&, const Scene&);
template ClusterForces<ThreeDimensional> forces_on(const Particles<ThreeDimensional>&, const Kernel<3>&,
                                                   const NeighbourLists&, const Records<ThreeDimensional>&,
                                                   const Scene&, int);
template void update_acceleration(Particles<ThreeDimensional>&, const Kernel<3>&, const NeighbourLists&,
                                  const Records<ThreeDimensional>&, const Scene&);

} // namespace host
