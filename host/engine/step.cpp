// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/step.hpp"
#include "host/engine/step_size.hpp"
#include <chrono>

namespace host {
namespace {

/// Runs `stage` and adds its time to the account.
template <class Geometry, class F> void timed(Simulation<Geometry>& s, Stage stage, F&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  s.stage_seconds[std::size_t(stage)] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Geometry> void deform_particles(Simulation<Geometry>& s) {
  const Increment increment{s.time + s.dt, s.time + s.dt, s.dt};
  const Medium medium = medium_of(s.scene);
  s.steepest =
      deform(s.particles, s.kernel, s.lists, medium, s.scene.material, increment, s.blocks, s.records);
  reflect_stress(s.images, s.surfaces, medium, s.records);
}

template <class Geometry> void move_particles(Simulation<Geometry>& s) {
  find_surfaces(planes_of_symmetry(s.scene), s.walls, s.scene.geometry, s.time + s.dt, s.dt,
                s.surfaces_ahead);
  const auto motion = move(s.particles, medium_of(s.scene), motion_terms(s), s.buffers, s.loads);
  s.work.add(motion.work);
  s.moved += std::sqrt(motion.square);
}

template <class Geometry> void advance_time(Simulation<Geometry>& s) {
  s.time += s.dt;
  s.dt_before = s.dt;
  ++s.steps;
}

} // namespace

template <class Geometry> void step(Simulation<Geometry>& s) {
  timed(s, Stage::neighbours, [&] { update_neighbours(s); });
  timed(s, Stage::wave_speed, [&] { choose_step(s); });
  timed(s, Stage::deformation, [&] { deform_particles(s); });
  timed(s, Stage::motion, [&] { move_particles(s); });
  advance_time(s);
}

template decltype(step<PlaneStrain>) step<PlaneStrain>;
template decltype(step<Axisymmetric>) step<Axisymmetric>;
template decltype(step<ThreeDimensional>) step<ThreeDimensional>;

} // namespace host
