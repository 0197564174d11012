// SPDX-License-Identifier: BSD-3-Clause
#include "host/momentum.hpp"
#include "host/geometry.hpp"
#include "host/momentum_solid.hpp"

namespace host {
namespace {

/// The eight particles of a cluster, from their records.
template <class Geometry>
PairSide<Geometry, Lane> gather_cluster(const StressRecord<Geometry>* records, int used) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  PairSide<Geometry, Lane> side;
  for (int l = 0; l < lanes; ++l) {
    const auto& r = records[std::min(l, used - 1)]; // padding repeats the last particle
    for (int a = 0; a < D; ++a) {
      side.position[a][l] = r.position[a];
      side.velocity[a][l] = r.velocity[a];
    }
    side.weight[l] = r.weight;
    side.density[l] = r.density;
    side.damping_speed[l] = r.damping_speed;
    for (int e = 0; e < D * D; ++e) {
      side.gradient[e][l] = r.gradient[e];
    }
    for (int s = 0; s < S; ++s) {
      side.flux[s][l] = r.flux[s];
      side.reduced_stress[s][l] = r.reduced_stress[s];
    }
  }
  return side;
}

/// The eight particles of a cluster, from their records.
SolidSide<Lane> gather_solid(const StressRecord<ThreeDimensional>* records, int used) {
  SolidSide<Lane> side;
  for (int l = 0; l < lanes; ++l) {
    const auto& r = records[std::min(l, used - 1)]; // padding repeats the last particle
    for (int a = 0; a < 3; ++a) {
      side.position[a][l] = r.position[a];
      side.velocity[a][l] = r.velocity[a];
    }
    side.density[l] = r.density;
    side.damping_speed[l] = r.damping_speed;
    for (int c = 0; c < 6; ++c) side.strain_rate[c][l] = r.strain_rate[c];
  }
  return side;
}

/// sigma_i sum g + sum sigma_j g.
void stress_force(const Lane (&stress)[6], const SolidSums<Lane>& sums, Lane (&force)[3]) {
  for (int a = 0; a < 3; ++a) {
    force[a] = sums.stress_force[a];
    for (int b = 0; b < 3; ++b) force[a] += stress[component<3>(a, b)] * sums.slope[b];
  }
}

} // namespace

template <>
void update_acceleration(Particles<ThreeDimensional>& p, const Kernel<3>& kernel, const NeighbourLists& lists,
                         const Records<ThreeDimensional>& records, const Scene& scene) {
  const double weight_gradient = scene.bulk_density * scene.gravity;
#pragma omp parallel for schedule(static)
  for (int c = 0; c < p.clusters(); ++c) {
    const int first = c * lanes;
    const auto i = gather_solid(&records.stress[first], std::min(lanes, p.count - first));
    SolidSums<Lane> inside, wall;
    const int* neighbour = lists.begin(c);
    for (int k = 0; k < lists.interior[c]; ++k)
      add_pair<true>(kernel, i, records.stress[neighbour[k]], inside);
    for (int k = lists.interior[c]; k < lists.total[c]; ++k)
      add_pair<false>(kernel, i, records.stress[neighbour[k]], wall);
    Lane stress[6], by_stress[3], by_walls[3], gradient[9];
    for (int s = 0; s < 6; ++s) stress[s] = load(&p.stress[s][first]);
    for (int e = 0; e < 9; ++e) gradient[e] = load(&p.velocity_gradient[e][first]);
    stress_force(stress, inside, by_stress);
    stress_force(stress, wall, by_walls);
    const Lane scale = 1.0 / i.density;
    for (int a = 0; a < 3; ++a) {
      store(&p.stress_acceleration[a][first], by_stress[a] * scale);
      store(&p.viscous_acceleration[a][first], inside.viscous[a] * scale);
      store(&p.wall_acceleration[a][first], (by_walls[a] + wall.viscous[a]) * scale);
    }
    const Lane twice_diffusivity = 2 * stress_diffusivity(scene.numerics.stress_diffusion, kernel.h,
                                                          load(&p.wave_speed[first]), gradient);
    for (int s = 0; s < 6; ++s) {
      Lane rate = stress[s] * inside.weight - inside.stress[s];
      if (s < 3) rate -= (s == 2 ? 1 : scene.earth_pressure_ratio) * weight_gradient * inside.slope[2];
      store(&p.stress_diffusion[s][first], rate * twice_diffusivity);
    }
  }
}

template <class Geometry>
void update_acceleration(Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                         const NeighbourLists& lists, const Records<Geometry>& records, const Scene& scene) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
#pragma omp parallel for schedule(static)
  for (int c = 0; c < p.clusters(); ++c) {
    const int first = c * lanes;
    const auto i = gather_cluster(&records.stress[first], std::min(lanes, p.count - first));
    Lane stress[D]{}, viscous[D]{}, wall[D]{}, diffusion[S]{};
    const int* neighbour = lists.begin(c);
    for (int k = 0; k < lists.interior[c]; ++k) {
      const auto& j = records.stress[neighbour[k]];
      const auto pair = make_pair(kernel, i, j);
      add_stress_force(pair, i, j, stress);
      add_viscous_force(kernel, pair, i, j, viscous);
      add_stress_diffusion(pair, i, j, diffusion);
    }
    for (int k = lists.interior[c]; k < lists.total[c]; ++k) {
      const auto& j = records.stress[neighbour[k]];
      const auto pair = make_pair(kernel, i, j);
      add_stress_force(pair, i, j, wall);
      add_viscous_force(kernel, pair, i, j, wall);
    }
    const Lane scale = 1.0 / (i.density * i.weight);
    for (int a = 0; a < D; ++a) {
      Lane by_stress = stress[a] * scale;
      if (Geometry::hoop && a == 0) by_stress -= load(&p.stress[2][first]) * scale;
      store(&p.stress_acceleration[a][first], by_stress);
      store(&p.viscous_acceleration[a][first], viscous[a] * scale);
      store(&p.wall_acceleration[a][first], wall[a] * scale);
    }
    const Lane twice_diffusivity = 2 * stress_diffusivity(scene.numerics.stress_diffusion, kernel.h,
                                                          load(&p.wave_speed[first]), i.gradient);
    for (int s = 0; s < S; ++s) store(&p.stress_diffusion[s][first], diffusion[s] * twice_diffusivity);
  }
}

template void update_acceleration(Particles<PlaneStrain>&, const Kernel<2>&, const NeighbourLists&,
                                  const Records<PlaneStrain>&, const Scene&);
template void update_acceleration(Particles<Axisymmetric>&, const Kernel<2>&, const NeighbourLists&,
                                  const Records<Axisymmetric>&, const Scene&);

} // namespace host
