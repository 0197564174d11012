// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/simulation.hpp"
#include "host/bodies/initial_particles.hpp"
#include "host/material/corotational.hpp"
#include "host/scheme/geometry.hpp"

namespace host {

template <class Geometry> Simulation<Geometry> start_simulation(const Scene& scene) {
  Simulation<Geometry> s{.scene = scene,
                         .kernel = Kernel<Geometry::dimension>(
                             scene.numerics.smoothing_length * scene.spacing, scene.numerics.kernel)};
  s.particles = initial_particles<Geometry>(scene);
  s.walls = all_walls(scene);
  s.loads.resize(s.walls.size());
  find_surfaces(planes_of_symmetry(scene), s.walls, scene.geometry, 0, 0, s.surfaces);
  s.blocks = make_stress_blocks(scene.material, s.particles, scene.spacing);
  s.blocks.dispersed_density = 0.5 * scene.bulk_density;
  s.blocks.failure_state = scene.failure_state;
  s.blocks.wave_speed_tolerance = scene.numerics.wave_speed_tolerance;
  if (scene.material.frame == Frame::green_naghdi) carry_deformation(s.particles);
  // The data check comes first, with initial stress and state in place; its answer is thrown away.
  update_wave_speed(s.particles, scene.material, s.blocks);
  // An increment without strain, so that the material's own initial state is there from the start: particles without
  // neighbours have no velocity gradient.
  constexpr double instant = 1e-12; // s
  const std::vector<int> none(s.particles.clusters(), 0);
  s.records.stress.resize(s.particles.padded());
  deform(s.particles, s.kernel, {0, {}, none, none}, medium_of(scene), scene.material,
         {instant, instant, instant}, s.blocks, s.records);
  s.initial_potential_energy = potential_energy(s.particles, scene.gravity);
  return s;
}

template <class Geometry> Memory memory_of(const Simulation<Geometry>& s) {
  const auto bytes = [](const auto& array) { return array.size() * sizeof(array[0]); };
  Memory memory;
  const auto count = [&](const Array& array) { memory.data += bytes(array); };
  s.particles.each_persistent(count);
  count(s.particles.diffusivity);
  memory.data += bytes(s.particles.id) + bytes(s.records.motion) + bytes(s.records.stress) +
                 bytes(s.images.list) + bytes(s.images.paths) + bytes(s.blocks.outdated) +
                 bytes(s.buffers.motion) + bytes(s.buffers.loads);
  for (const NeighbourLists* lists : {&s.outer_lists, &s.lists})
    memory.lists += bytes(lists->entries) + bytes(lists->interior) + bytes(lists->total) +
                    bytes(lists->screened) + bytes(lists->sight_start) + bytes(lists->sight);
  return memory;
}

template decltype(start_simulation<PlaneStrain>) start_simulation<PlaneStrain>;
template decltype(start_simulation<Axisymmetric>) start_simulation<Axisymmetric>;
template decltype(start_simulation<ThreeDimensional>) start_simulation<ThreeDimensional>;
template decltype(memory_of<PlaneStrain>) memory_of<PlaneStrain>;
template decltype(memory_of<Axisymmetric>) memory_of<Axisymmetric>;
template decltype(memory_of<ThreeDimensional>) memory_of<ThreeDimensional>;

} // namespace host
