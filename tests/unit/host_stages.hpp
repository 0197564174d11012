// SPDX-License-Identifier: BSD-3-Clause
// The stages of a step one by one over all particles, with what one leaves to the next, so that a test can look at it
// or prescribe it. The work for a cluster or a block is done by the functions that the passes of a step call
// (host/engine/passes.cpp).
#pragma once
#include "host/engine/gradient.hpp"
#include "host/engine/material_calls.hpp"
#include "host/engine/momentum.hpp"
#include "host/engine/simulation.hpp"
#include "host/engine/stress.hpp"

namespace host_test {

/// Results of the stages, as those of the particles padded to whole clusters. All zero at first.
template <class Geometry> struct Stages {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  std::array<host::Array, D * D> velocity_gradient; ///< 1/s, component a * D + b is d v_a / d x_b
  std::array<host::Array, D> stress_acceleration, viscous_acceleration, wall_acceleration; ///< m/s2
  std::array<host::Array, S> stress_diffusion;                                             ///< Pa/s

  explicit Stages(const host::Particles<Geometry>& p) {
    each([&](host::Array& a) { a.assign(p.padded(), 0.0); });
  }
  template <class F> void each(F&& f) {
    for (auto& a : velocity_gradient) f(a);
    for (auto* group : {&stress_acceleration, &viscous_acceleration, &wall_acceleration})
      for (auto& a : *group) f(a);
    for (auto& a : stress_diffusion) f(a);
  }
};

template <class Geometry>
void update_gradient(const host::Particles<Geometry>& p, const host::Kernel<Geometry::dimension>& kernel,
                     const host::NeighbourLists& lists, const host::Records<Geometry>& records,
                     Stages<Geometry>& stages) {
  constexpr int parts = Geometry::dimension * Geometry::dimension;
  for (int c = 0; c < p.clusters(); ++c) {
    host::Lane gradient[parts];
    find_gradient(p, kernel, lists, records, c, gradient);
    for (int e = 0; e < parts; ++e) host::store(&stages.velocity_gradient[e][c * host::lanes], gradient[e]);
  }
}

/// Throws what the pass of a step throws.
template <class Geometry>
void update_stress(host::Particles<Geometry>& p, const host::Material& material,
                   const host::Increment& increment, host::StressBlocks& blocks,
                   const Stages<Geometry>& stages) {
  host::FirstFailure failure;
  for_each_block(p, material, blocks, [&](int first, host::VumatBlock& b) {
    host::BlockGradient<Geometry> gradient{};
    for (std::size_t e = 0; e < stages.velocity_gradient.size(); ++e)
      std::copy_n(&stages.velocity_gradient[e][first], b.points, gradient.component[e]);
    advance_stress(p, material, increment, blocks, gradient, first, b, failure);
  });
  if (failure.bad) report_failure(p, material, failure, blocks.failure_state);
}

template <class Geometry>
void write_stress_records(host::Particles<Geometry>& p, const host::Scene& scene, double smoothing_length,
                          const Stages<Geometry>& stages, host::Records<Geometry>& records) {
  for (int first = 0; first < p.count; first += host::lanes) {
    host::ClusterGradient<Geometry> gradient;
    for (std::size_t e = 0; e < gradient.size(); ++e)
      gradient[e] = host::load(&stages.velocity_gradient[e][first]);
    write_stress_records(p, first, std::min(host::lanes, p.count - first), gradient, medium_of(scene),
                         smoothing_length, records);
  }
}

template <class Geometry>
void update_acceleration(const host::Particles<Geometry>& p, const host::Kernel<Geometry::dimension>& kernel,
                         const host::NeighbourLists& lists, const host::Records<Geometry>& records,
                         const host::Scene& scene, Stages<Geometry>& stages) {
  for (int c = 0; c < p.clusters(); ++c) {
    const auto forces = forces_on(p, kernel, lists, records, medium_of(scene), c);
    for (int a = 0; a < Geometry::dimension; ++a) {
      host::store(&stages.stress_acceleration[a][c * host::lanes], forces.stress[a]);
      host::store(&stages.viscous_acceleration[a][c * host::lanes], forces.viscous[a]);
      host::store(&stages.wall_acceleration[a][c * host::lanes], forces.wall[a]);
    }
    for (int s = 0; s < Geometry::stress_components; ++s)
      host::store(&stages.stress_diffusion[s][c * host::lanes], forces.diffusion[s]);
  }
}

/// Kick, push of walls, drift and contact; returns the work of the step. Stress diffuses in `diffuse`.
template <class Geometry>
host::Work integrate(const host::MotionTerms<Geometry>& terms, host::Particles<Geometry>& p,
                     const Stages<Geometry>& stages) {
  host::Motion motion;
  std::vector<host::WallLoad> loads(terms.walls.walls.size());
  host::PushBuffer<Geometry::dimension> buffer;
  for (int c = 0; c < p.clusters(); ++c) {
    host::ClusterForces<Geometry> by{};
    for (int a = 0; a < Geometry::dimension; ++a) {
      by.stress[a] = host::load(&stages.stress_acceleration[a][c * host::lanes]);
      by.viscous[a] = host::load(&stages.viscous_acceleration[a][c * host::lanes]);
      by.wall[a] = host::load(&stages.wall_acceleration[a][c * host::lanes]);
    }
    move_cluster(terms, by, c, p, motion, loads, buffer);
  }
  return motion.work;
}

/// The same for a simulation whose lists are up to date.
template <class Geometry>
host::Work integrate(host::Simulation<Geometry>& s, const Stages<Geometry>& stages) {
  host::find_surfaces(host::planes_of_symmetry(s.scene), s.walls, s.scene.geometry, s.time + s.dt, s.dt,
                      s.surfaces_ahead);
  return integrate(motion_terms(s), s.particles, stages);
}

template <class Geometry>
void diffuse(host::Particles<Geometry>& p, double dt, const Stages<Geometry>& stages) {
  for (std::size_t c = 0; c < p.stress.size(); ++c)
    for (int i = 0; i < p.count; ++i) p.stress[c][i] += dt * stages.stress_diffusion[c][i];
}

} // namespace host_test
