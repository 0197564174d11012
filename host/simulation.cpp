// SPDX-License-Identifier: BSD-3-Clause
#include "host/simulation.hpp"
#include "host/geometry.hpp"
#include "host/lattice.hpp"
#include <chrono>
#include <fmt/format.h>

namespace host {
namespace {

/// Runs `stage` and adds its time to the account.
template <class Geometry, class F> void timed(Simulation<Geometry>& s, Stage stage, F&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  s.stage_seconds[std::size_t(stage)] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Geometry> void show_all_motion(Simulation<Geometry>& s) {
  show_motion(s.particles, s.records);
  reflect_motion(s.images, s.mirrors, s.records);
}

template <class Geometry> void update_neighbours(Simulation<Geometry>& s) {
  const double skin = s.scene.numerics.skin * s.scene.spacing, reach = s.kernel.support + skin;
  move_gate(s.mirrors, s.scene, s.time);
  if (s.rebuilds == 0 || largest_displacement(s.particles, s.listed_position) > 0.5 * skin) {
    sort_particles(s.particles, 0.25 * s.scene.spacing);
    s.images = find_images(s.particles, s.mirrors, reach);
    const std::size_t size = s.particles.padded() + s.images.list.size();
    s.records.motion.resize(size);
    s.records.stress.resize(size);
    show_all_motion(s);
    find_neighbours(s.particles, s.images, s.records, reach, s.lists);
    s.listed_position = s.particles.position;
    ++s.rebuilds;
  } else
    show_all_motion(s);
}

/// Step from the current wave speed. It shrinks at once and grows slowly: a deposit that opens up for a
/// moment shows no wave, and stiffens again within a few steps.
template <class Geometry> void choose_step(Simulation<Geometry>& s) {
  constexpr double growth = 1.02, smallest = 1e-4; // of the step before; of the first step
  update_wave_speed(s.particles, s.scene.material, s.blocks);
  double fastest = 0;
  int at = 0;
  for (int i = 0; i < s.particles.count; ++i) {
    double square = 0;
    for (const auto& v : s.particles.velocity) square += v[i] * v[i];
    const double speed = s.particles.wave_speed[i] + std::sqrt(square);
    if (speed <= fastest) continue; // false for what is not a number
    fastest = speed;
    at = i;
  }
  const double wanted = s.scene.numerics.step_factor * s.kernel.h / fastest;
  s.dt = s.steps == 0 ? wanted : std::min(wanted, growth * s.dt);
  if (s.steps == 0) s.first_dt = s.dt;
  if (!(s.dt > smallest * s.first_dt) || !std::isfinite(s.dt))
    throw std::runtime_error(fmt::format(
        "the motion became unstable at time {:.9g} s: the step fell to {:.3g} s (first: {:.3g} s), "
        "particle {} at ({:.6g}, {:.6g}) m has wave and flow speeds of {:.3g} m/s together",
        s.time, s.dt, s.first_dt, s.particles.id[at], s.particles.position[0][at],
        s.particles.position[1][at], fastest));
}

template <class Geometry> void show_all_stress(Simulation<Geometry>& s) {
  show_stress(s.particles, s.scene, s.kernel.h, s.records);
  reflect_stress(s.images, s.mirrors, s.records);
}

} // namespace

template <class Geometry> Simulation<Geometry> start_simulation(const Scene& scene) {
  Simulation<Geometry> s{
      .scene = scene, .kernel = Kernel<Geometry::dimension>(scene.numerics.smoothing_length * scene.spacing)};
  s.particles = make_column<Geometry>(scene);
  s.mirrors = scene_mirrors(scene);
  s.blocks = make_stress_blocks(scene.material, s.particles, scene.spacing);
  s.blocks.failure_state = scene.failure_state;
  // An increment without strain, so that the material's own initial state is there from the start.
  constexpr double instant = 1e-12; // s
  update_stress(s.particles, scene.material, {instant, instant, instant}, s.blocks);
  s.initial_potential_energy = potential_energy(s.particles, scene.gravity);
  return s;
}

template <class Geometry> void step(Simulation<Geometry>& s) {
  timed(s, Stage::neighbours, [&] { update_neighbours(s); });
  timed(s, Stage::wave_speed, [&] { choose_step(s); });
  timed(s, Stage::gradient, [&] { update_gradient(s.particles, s.kernel, s.lists, s.records); });
  const Increment increment{s.time + s.dt, s.time + s.dt, s.dt};
  timed(s, Stage::stress, [&] {
    update_stress(s.particles, s.scene.material, increment, s.blocks);
    show_all_stress(s);
  });
  timed(s, Stage::momentum,
        [&] { update_acceleration(s.particles, s.kernel, s.lists, s.records, s.scene.numerics); });
  timed(s, Stage::integrate,
        [&] { s.work.add(integrate(s.particles, s.scene, s.mirrors, s.kernel.support, s.dt_before, s.dt)); });
  s.time += s.dt;
  s.dt_before = s.dt;
  ++s.steps;
}

template Simulation<PlaneStrain> start_simulation(const Scene&);
template Simulation<Axisymmetric> start_simulation(const Scene&);
template void step(Simulation<PlaneStrain>&);
template void step(Simulation<Axisymmetric>&);

} // namespace host
