// SPDX-License-Identifier: BSD-3-Clause
// The counter-case: smoothed particles as in an early textbook, for the tests that show what goes wrong with them.
// Cubic spline, plain sums for the velocity gradient, sigma/rho^2 pair forces, viscosity on the whole velocity
// difference (Monaghan 1992), no stress diffusion; stress by the host's own stage and material. Plane strain.
#pragma once
#include "host/scheme/geometry.hpp"
#include "tests/stability/stages.hpp"
#include <cmath>
#include <numbers>
#include <omp.h>

namespace stability {

/// Hundreds of particles are too few to share.
inline const int one_thread = (omp_set_num_threads(1), 1);

/// W'(r)/r of the cubic spline in the plane, support 2 h.
inline double cubic_gradient_factor(double r, double h) {
  const double q = r / h, alpha = 10 / (7 * std::numbers::pi * h * h);
  if (q >= 2 || q == 0) return 0;
  const double slope = q < 1 ? -3 * q + 2.25 * q * q : -0.75 * (2 - q) * (2 - q);
  return alpha * slope / (h * r);
}

struct Naive {
  double alpha = 0.1;       ///< of the viscosity
  double step_factor = 0.2; ///< of h / (c + |v|)
};

/// Returns what the stages of the step found.
inline Stages naive_step(host::Simulation<host::PlaneStrain>& s, const Naive& naive = {}) {
  auto& p = s.particles;
  const double h = s.kernel.h;
  host::find_surfaces(host::planes_of_symmetry(s.scene), s.walls, s.scene.geometry, s.time, s.dt_before,
                      s.surfaces);
  host::update_lists(s);
  host::update_wave_speed(p, s.scene.material, s.blocks);
  double fastest = 0;
  for (int i = 0; i < p.count; ++i)
    fastest = std::max(fastest, p.wave_speed[i] + std::hypot(p.velocity[0][i], p.velocity[1][i]));
  s.dt = naive.step_factor * h / fastest;

  Stages found(p);
  // f(i, record of j, x_i - x_j, V_j W'/r)
  const auto each_pair = [&](auto&& f) {
    for (int c = 0; c < p.clusters(); ++c)
      for (int i = c * host::lanes; i < std::min((c + 1) * host::lanes, p.count); ++i)
        for (int k = 0; k < s.lists.total[c]; ++k) {
          const int j = s.lists.begin(c)[k];
          const auto& record = s.records.motion[j];
          const double x = p.position[0][i] - record.position[0], y = p.position[1][i] - record.position[1];
          f(i, j, k >= s.lists.interior[c], x, y, record.volume * cubic_gradient_factor(std::hypot(x, y), h));
        }
  };
  each_pair([&](int i, int j, bool, double x, double y, double w) {
    const double* v = s.records.motion[j].velocity;
    for (int a = 0; a < 2; ++a) {
      found.velocity_gradient[2 * a][i] += (v[a] - p.velocity[a][i]) * w * x;
      found.velocity_gradient[2 * a + 1][i] += (v[a] - p.velocity[a][i]) * w * y;
    }
  });
  update_stress(p, s.scene.material, {s.time + s.dt, s.time + s.dt, s.dt}, s.blocks, found);
  write_stress_records(p, s.scene, h, found, s.records);
  host::reflect_stress(s.images, s.surfaces, {}, s.records); // without weight: a mirror image and no more

  each_pair([&](int i, int j, bool wall, double x, double y, double w) {
    const auto& r = s.records.stress[j];
    const double* v = s.records.motion[j].velocity;
    const double rho = p.density[i], ratio = r.density; // V_j = m_j / rho_j
    double sum[3];                                      // sigma_i / rho_i^2 + sigma_j / rho_j^2, times rho_j
    constexpr int place[3] = {0, 1, 3};
    for (int c = 0; c < 3; ++c)
      sum[c] = ratio * (p.stress[place[c]][i] / (rho * rho) + r.stress[place[c]] / (r.density * r.density));
    const double approach = (p.velocity[0][i] - v[0]) * x + (p.velocity[1][i] - v[1]) * y;
    const double viscous =
        approach < 0 ? naive.alpha * h * p.wave_speed[i] * approach / (x * x + y * y + 0.01 * h * h) : 0;
    auto& stress = wall ? found.wall_acceleration : found.stress_acceleration;
    auto& viscosity = wall ? found.wall_acceleration : found.viscous_acceleration;
    stress[0][i] += (sum[0] * x + sum[2] * y) * w;
    stress[1][i] += (sum[2] * x + sum[1] * y) * w;
    viscosity[0][i] += viscous * x * w;
    viscosity[1][i] += viscous * y * w;
  });
  s.work.add(integrate(s, found));
  s.time += s.dt;
  s.dt_before = s.dt;
  ++s.steps;
  return found;
}

} // namespace stability
