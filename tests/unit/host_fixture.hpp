// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the pair loops share: disordered particles, arranged and listed as a step does it.
#pragma once
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/unit/host_stages.hpp"
#include <array>
#include <random>

namespace host_test {

inline constexpr double spacing = 0.002; // m

/// Room for `count` particles and nothing else yet.
template <class Geometry>
host::Simulation<Geometry> empty_cloud(int count, const host::Scene& scene = {}, int state_variables = 0) {
  host::Simulation<Geometry> s{.scene = scene,
                               .kernel = host::Kernel<Geometry::dimension>(
                                   scene.numerics.smoothing_length * spacing, scene.numerics.kernel)};
  s.particles.resize(count, state_variables);
  return s;
}

template <class Geometry> using Place = std::array<double, Geometry::dimension>;

/// Particle i at `place`, m, with what a square or cube of the lattice holds.
template <class Geometry> void put(host::Particles<Geometry>& p, int i, const Place<Geometry>& place) {
  p.id[i] = i;
  double area = 1;
  for (int a = 0; a < Geometry::dimension; ++a) {
    p.position[a][i] = place[a];
    area *= spacing;
  }
  p.density[i] = 1500;
  p.mass[i] = 1500 * area * Geometry::depth * Geometry::weight(place[0]);
}

/// Particle i of a block of `across` particles in each horizontal direction, counted in spacings from `corner`,
/// moved by up to `jitter` of a spacing.
template <class Geometry, class Random>
Place<Geometry> in_block(int i, int across, double corner, Random& random, double jitter) {
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  Place<Geometry> place;
  for (int a = 0; a < Geometry::dimension; ++a) {
    const bool last = a == Geometry::dimension - 1;
    place[a] = (corner + (last ? i : i % across) + shift(random)) * spacing;
    i /= across;
  }
  return place;
}

/// Puts the walls of the scene where they are at `time`, s.
template <class Geometry> void place_walls(host::Simulation<Geometry>& s, double time = 0) {
  s.walls = host::all_walls(s.scene);
  host::find_surfaces(host::planes_of_symmetry(s.scene), s.walls, s.scene.geometry, time, 0, s.surfaces);
}

/// Sorts by cells of `cell`, m, and makes the images of what is within `reach`, m, of a surface.
template <class Geometry> void arrange(host::Simulation<Geometry>& s, double cell, double reach) {
  sort_particles(s.particles, cell);
  find_images(s.particles, s.surfaces, reach, 0.0, s.images);
  s.records.motion.resize(s.particles.padded() + s.images.list.size());
  s.records.stress.resize(s.records.motion.size());
}

template <class Geometry> void show(host::Simulation<Geometry>& s) {
  show_motion(s.particles, s.records);
  reflect_motion(s.images, s.surfaces, s.records);
}

template <class Geometry> void find_lists(host::Simulation<Geometry>& s, double reach) {
  show(s);
  find_neighbours(s.particles, s.images, s.records, reach, s.lists);
}

template <class Geometry> Stages<Geometry> find_gradients(host::Simulation<Geometry>& s) {
  find_lists(s, s.kernel.support);
  Stages<Geometry> stages(s.particles);
  update_gradient(s.particles, s.kernel, s.lists, s.records, stages);
  return stages;
}

} // namespace host_test
