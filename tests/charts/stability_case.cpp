// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/guard.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/charts/sand.hpp"
#include "tests/charts/stability.hpp"
#include "tests/charts/stress_noise.hpp"
#include <algorithm>
#include <numbers>

namespace charts {
namespace {

constexpr double radius = 0.05, gravity = 9.81, grain_density = 2500; // m, m/s2, kg/m3
constexpr double grain_diameter = 0.00295;                            // m
constexpr double fall_time = 0.214, duration = 0.3;                   // s: 3 and 4.2 sqrt(h0/g)

host::Material sand_material() {
  return {.library = host::load_vumat(host::beside_program("libsimsand_vumat.so")),
          .name = "SIMSAND",
          .properties = properties(sands[1]),
          .state_variables = int(simsand::state_variables.size())};
}

host::Material elastic_material() {
  return {.library = host::load_vumat(host::beside_program("libelastic_vumat.so")),
          .name = "ELASTIC",
          .properties = {1e6, 0.3}};
}

host::Scene scene_of(const StabilityCase& c) {
  host::Scene scene;
  scene.geometry = c.geometry;
  scene.spacing = radius / c.particles_per_radius;
  scene.gravity = gravity;
  scene.column = {radius, radius};
  scene.material = c.material == "elastic" ? elastic_material() : sand_material();
  scene.initial_state.assign(scene.material.state_variables, 0.0);
  if (c.material != "elastic") scene.failure_state = simsand::statev::status;
  scene.bulk_density = grain_density / (1 + sands[1].dense);
  scene.earth_pressure_ratio =
      c.material == "elastic" ? 0.3 / 0.7 : 1 - std::sin(sands[1].phi * std::numbers::pi / 180);
  scene.floor.friction = 0.5;
  scene.gate.motion = host::GateMotion::remove;
  scene.numerics.smoothing_length = c.smoothing_length;
  scene.numerics.viscosity *= c.viscosity;
  scene.numerics.flow_viscosity *= c.viscosity;
  scene.numerics.stress_diffusion = c.stress_diffusion;
  scene.numerics.step_factor = c.step_factor;
  return scene;
}

/// Which guard speaks.
std::string guard_of(const std::string& message) {
  if (message.find("strains by") != std::string::npos) return "strain";
  if (message.find("the step fell") != std::string::npos) return "step";
  if (message.find("energy went wrong") != std::string::npos) return "energy";
  return "material";
}

/// What is noted while a run goes on.
template <class Geometry> class Witness {
public:
  explicit Witness(const host::Simulation<Geometry>& s) : thrown(s.particles.count, false) {}

  void note(const host::Simulation<Geometry>& s, StabilityOutcome& out) {
    const auto& p = s.particles;
    const double e0 = s.initial_potential_energy;
    const double kinetic = host::kinetic_energy(p) / e0, gained = host::potential_energy(p, gravity) / e0 - 1;
    const double made = kinetic + gained - std::max(s.work.wall, 0.0) / e0,
                 unclosed = kinetic + gained - s.work.total() / e0;
    out.kinetic_peak = std::max(out.kinetic_peak, kinetic);
    if (s.time < 0.1 * duration) out.kinetic_start = std::max(out.kinetic_start, kinetic);
    if (s.time > 0.9 * duration) out.kinetic_end = std::max(out.kinetic_end, kinetic);
    out.made = std::max(out.made, made);
    out.imbalance = std::max(out.imbalance, std::abs(unclosed));
    for (int i = 0; i < p.count; ++i) {
      const double square = p.velocity[0][i] * p.velocity[0][i] + p.velocity[1][i] * p.velocity[1][i];
      if (!(0.5 * square + gravity * p.position[1][i] <= 1.05 * gravity * radius)) thrown[p.id[i]] = true;
    }
    out.thrown = double(std::count(thrown.begin(), thrown.end(), true)) / p.count;
    if (s.time < fall_time && s.time >= next_noise) {
      next_noise += fall_time / 20;
      noise += checkerboard_index(p, s.kernel, 20);
      out.noise = noise / ++looks;
    }
    host::check_energy(p, s.time, made, unclosed);
  }

private:
  std::vector<bool> thrown;
  double next_noise = fall_time / 20, noise = 0;
  int looks = 0;
};

std::string verdict_of(const StabilityCase& c, const StabilityOutcome& o) {
  if (o.ended != "end") return "stopped: " + o.ended;
  if (!(o.thrown <= most_thrown)) return "thrown";
  if (!(o.kinetic_end <= (c.material == "elastic" ? o.kinetic_start : most_kinetic_end))) return "restless";
  return "holds";
}

template <class Geometry> StabilityOutcome run(const StabilityCase& c) {
  StabilityOutcome out;
  auto s = host::start_simulation<Geometry>(scene_of(c));
  Witness<Geometry> witness(s);
  out.particles = s.particles.count;
  out.ended = "end";
  try {
    constexpr int between = 16; // steps from look to look
    while (s.time < duration) {
      host::step(s);
      if (s.steps % between == 0) witness.note(s, out);
    }
    witness.note(s, out);
    const auto radii = host::outline_radii(s.scene.spacing, 8 * radius);
    const auto profile = host::outline(s.particles, s.kernel, radii);
    out.height = host::outline_height(profile) / radius;
    out.front = host::front_radius(radii, profile, grain_diameter) / radius;
  } catch (const std::runtime_error& error) {
    out.ended = guard_of(error.what());
  }
  out.steps = s.steps;
  out.end_time = s.time;
  out.verdict = verdict_of(c, out);
  return out;
}

} // namespace

StabilityOutcome run_stability_case(const StabilityCase& c) {
  if (c.geometry == host::GeometryKind::plane_strain) return run<host::PlaneStrain>(c);
  return run<host::Axisymmetric>(c);
}

} // namespace charts
