// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the pair loops share: disordered particles, arranged and listed as a step does it.
#pragma once
#include "host/geometry.hpp"
#include "host/simulation.hpp"
#include <array>
#include <random>

namespace host_test {

inline constexpr double spacing = 0.002; // m

/// Room for `count` particles and nothing else yet.
template <class Geometry>
host::Simulation<Geometry> empty_cloud(int count, const host::Scene& scene = {}, int state_variables = 0) {
  host::Simulation<Geometry> s{.scene = scene,
                               .kernel = host::Kernel<2>(scene.numerics.smoothing_length * spacing)};
  s.particles.resize(count, state_variables);
  return s;
}

/// Particle i at `place`, m, with what a square of the lattice holds.
template <class Geometry> void put(host::Particles<Geometry>& p, int i, const std::array<double, 2>& place) {
  p.id[i] = i;
  for (int a = 0; a < 2; ++a) p.position[a][i] = place[a];
  p.density[i] = 1500;
  p.mass[i] = 1500 * spacing * spacing * Geometry::depth * Geometry::weight(place[0]);
}

/// Sorts by cells of `cell`, m, and makes the images of what is within `reach`, m, of a mirror.
template <class Geometry> void arrange(host::Simulation<Geometry>& s, double cell, double reach) {
  sort_particles(s.particles, cell);
  s.images = find_images(s.particles, s.mirrors, reach);
  s.records.motion.resize(s.particles.padded() + s.images.list.size());
  s.records.stress.resize(s.records.motion.size());
}

template <class Geometry> void show(host::Simulation<Geometry>& s) {
  show_motion(s.particles, s.records);
  reflect_motion(s.images, s.mirrors, s.records);
}

template <class Geometry> void find_lists(host::Simulation<Geometry>& s, double reach) {
  show(s);
  find_neighbours(s.particles, s.images, s.records, reach, s.lists);
}

template <class Geometry> void find_gradients(host::Simulation<Geometry>& s) {
  find_lists(s, s.kernel.support);
  update_gradient(s.particles, s.kernel, s.lists, s.records);
}

} // namespace host_test
