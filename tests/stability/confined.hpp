// SPDX-License-Identifier: BSD-3-Clause
// A body in the plane under a pressure on all its free surface, without a membrane: pair forces are of the stress less
// that pressure, so a body at this pressure is at rest. The stages are the product's.
#pragma once
#include "host/scheme/geometry.hpp"
#include "tests/stability/stages.hpp"
#include <cmath>

namespace stability {

/// One step under `pressure`, Pa, compression positive. `drive(particles, stages)` sets velocities that are prescribed, after
/// the kick and before the drift of the next step.
template <class Drive>
void confined_step(host::Simulation<host::PlaneStrain>& s, double pressure, Drive&& drive) {
  auto& p = s.particles;
  host::update_lists(s);
  host::update_wave_speed(p, s.scene.material, s.blocks);
  double fastest = 0;
  for (int i = 0; i < p.count; ++i)
    fastest = std::max(fastest, p.wave_speed[i] + std::hypot(p.velocity[0][i], p.velocity[1][i]));
  s.dt = s.scene.numerics.step_factor * s.kernel.h / fastest;
  Stages stages(p);
  update_gradient(p, s.kernel, s.lists, s.records, stages);
  update_stress(p, s.scene.material, {s.time + s.dt, s.time + s.dt, s.dt}, s.blocks, stages);
  const auto add = [&](double stress) {
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < p.count; ++i) p.stress[c][i] += stress;
  };
  add(pressure);
  write_stress_records(p, s.scene, s.kernel.h, stages, s.records);
  host::reflect_stress(s.images, s.surfaces, medium_of(s.scene), s.records);
  update_acceleration(p, s.kernel, s.lists, s.records, s.scene, stages);
  add(-pressure);
  drive(p, stages);
  s.work.add(integrate(s, stages));
  diffuse(p, s.dt, stages);
  s.time += s.dt;
  s.dt_before = s.dt;
  ++s.steps;
}

} // namespace stability
