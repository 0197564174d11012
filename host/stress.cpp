// SPDX-License-Identifier: BSD-3-Clause
#include "host/stress.hpp"
#include "host/geometry.hpp"
#include <atomic>
#include <fmt/format.h>
#include <omp.h>
#include <stdexcept>

namespace host {
namespace {

/// Strain increment in the order of the VUMAT and the angle the material turns by.
struct StepStrain {
  std::array<double, 4> strain;
  double angle;
};

/// Hoop strain rate v_r / r. Within a spacing of the axis it is d v_r / d r, which is the same where a flow is
/// regular: there v_r / r turns each jitter of the innermost ring into strain, and its stress would grow
/// to many times that of its neighbours during a collapse.
template <class Geometry> double hoop_rate(const Particles<Geometry>& p, int i, double spacing) {
  if (!Geometry::hoop) return 0;
  return p.position[0][i] < spacing ? p.velocity_gradient[0][i] : p.velocity[0][i] / p.position[0][i];
}

template <class Geometry>
StepStrain step_strain(const Particles<Geometry>& p, int i, double dt, double spacing) {
  const double shear = 0.5 * (p.velocity_gradient[1][i] + p.velocity_gradient[2][i]) * dt;
  return {
      {p.velocity_gradient[0][i] * dt, p.velocity_gradient[3][i] * dt, hoop_rate(p, i, spacing) * dt, shear},
      0.5 * (p.velocity_gradient[2][i] - p.velocity_gradient[1][i]) * dt};
}

/// In-plane tensor (11, 22, 33, 12) turned by `angle` from axis 1 to axis 2.
std::array<double, 4> turned(const std::array<double, 4>& s, double angle) {
  const double cosine = std::cos(2 * angle), sine = std::sin(2 * angle);
  const double mean = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
  const double turned_half = half * cosine - s[3] * sine;
  return {mean + turned_half, mean - turned_half, s[2], half * sine + s[3] * cosine};
}

template <class Geometry> std::array<double, 4> stress_of(const Particles<Geometry>& p, int i) {
  return {p.stress[0][i], p.stress[1][i], p.stress[2][i], p.stress[3][i]};
}

/// Inputs of a call for particles first, first + 1, ...
template <class Geometry> void pack(const Particles<Geometry>& p, int first, double spacing, VumatBlock& b) {
  const int n = b.points;
  for (int k = 0; k < n; ++k) {
    const int i = first + k;
    for (int a = 0; a < Geometry::dimension; ++a) b.coordinates[a * n + k] = p.position[a][i];
    b.char_length[k] = spacing;
    b.density[k] = p.density[i];
    b.internal_energy_old[k] = p.internal_energy[i];
    b.inelastic_energy_old[k] = p.inelastic_energy[i];
  }
  for (int s = 0; s < b.state_variables; ++s) std::copy_n(&p.state[s][first], n, &b.state_old[s * n]);
}

/// Index in the block of the first point whose answer is not finite or whose material reports a failure; -1 if
/// there is none.
int first_failure(const VumatBlock& b, int failure_state) {
  for (int k = 0; k < b.points; ++k) {
    double all = 0; // not finite if any of them is not
    for (std::size_t c = k; c < b.stress_new.size(); c += b.points) all += b.stress_new[c] * 0;
    for (std::size_t c = k; c < b.state_new.size(); c += b.points) all += b.state_new[c] * 0;
    all += b.internal_energy_new[k] * 0 + b.inelastic_energy_new[k] * 0;
    if (!std::isfinite(all)) return k;
    if (failure_state >= 0 && b.state_new[failure_state * b.points + k] < 0) return k;
  }
  return -1;
}

/// Keeps the lowest number of a particle whose update failed; false if the block has none.
bool note_failure(int first, const VumatBlock& b, int failure_state, std::atomic<int>& failed) {
  const int k = first_failure(b, failure_state);
  if (k < 0) return false;
  int lowest = failed;
  while (first + k < lowest && !failed.compare_exchange_weak(lowest, first + k)) {}
  return true;
}

/// Calls `f(first, block)` for all particles, each thread with a block of its own.
template <class F> void for_each_block(int count, StressBlocks& blocks, F&& f) {
  const int full = count / StressBlocks::points;
#pragma omp parallel for schedule(static)
  for (int b = 0; b < full; ++b) f(b * StressBlocks::points, blocks.full[omp_get_thread_num()]);
  if (!blocks.tail.empty()) f(full * StressBlocks::points, blocks.tail.front());
}

template <class Geometry>
[[noreturn]] void report_failure(const Particles<Geometry>& p, const Material& material,
                                 const Increment& increment, int i, double spacing) {
  const auto step = step_strain(p, i, increment.dt, spacing);
  throw std::runtime_error(fmt::format(
      "material {} returned a number that is not finite or reported a failure: particle {} at time {:.9g} s, "
      "position ({:.6g}, "
      "{:.6g}) m, "
      "stress before ({:.9g}, {:.9g}, {:.9g}, {:.9g}) Pa, strain increment ({:.6g}, {:.6g}, {:.6g}, {:.6g})",
      material.name, p.id[i], increment.total_time, p.position[0][i], p.position[1][i], p.stress[0][i],
      p.stress[1][i], p.stress[2][i], p.stress[3][i], step.strain[0], step.strain[1], step.strain[2],
      step.strain[3]));
}

} // namespace

template <class Geometry>
StressBlocks make_stress_blocks(const Material& material, const Particles<Geometry>& p, double spacing) {
  StressBlocks blocks;
  blocks.spacing = spacing;
  blocks.full.assign(omp_get_max_threads(),
                     VumatBlock(material, StressBlocks::points, Geometry::shear_components));
  if (const int left = p.count % StressBlocks::points)
    blocks.tail.emplace_back(material, left, Geometry::shear_components);
  return blocks;
}

template <class Geometry>
void update_stress(Particles<Geometry>& p, const Material& material, const Increment& increment,
                   StressBlocks& blocks) {
  std::atomic<int> failed = p.count;
  for_each_block(p.count, blocks, [&](int first, VumatBlock& b) {
    const int n = b.points;
    pack(p, first, blocks.spacing, b);
    for (int k = 0; k < n; ++k) {
      const int i = first + k;
      const auto step = step_strain(p, i, increment.dt, blocks.spacing);
      const auto old_stress = turned(stress_of(p, i), step.angle);
      for (int c = 0; c < 4; ++c) {
        b.strain_increment[c * n + k] = step.strain[c];
        b.stress_old[c * n + k] = old_stress[c] + p.stress_diffusion[c][i] * increment.dt;
      }
      const double volumetric = step.strain[0] + step.strain[1] + step.strain[2];
      p.density[i] *= (1 - 0.5 * volumetric) / (1 + 0.5 * volumetric); // exp(-volumetric) to third order
      b.density[k] = p.density[i];
    }
    call_vumat(material, increment, b);
    if (note_failure(first, b, blocks.failure_state, failed)) return;
    for (int c = 0; c < 4; ++c) std::copy_n(&b.stress_new[c * n], n, &p.stress[c][first]);
    for (int s = 0; s < b.state_variables; ++s) std::copy_n(&b.state_new[s * n], n, &p.state[s][first]);
    std::copy_n(b.internal_energy_new.begin(), n, &p.internal_energy[first]);
    std::copy_n(b.inelastic_energy_new.begin(), n, &p.inelastic_energy[first]);
  });
  if (failed < p.count) report_failure(p, material, increment, failed, blocks.spacing);
}

template <class Geometry>
void update_wave_speed(Particles<Geometry>& p, const Material& material, StressBlocks& blocks) {
  std::atomic<int> failed = p.count;
  constexpr double probe = -1e-6; // strain; compression, so that the probe itself never separates
  for_each_block(p.count, blocks, [&](int first, VumatBlock& b) {
    const int n = b.points;
    pack(p, first, blocks.spacing, b);
    for (int k = 0; k < n; ++k)
      for (int c = 0; c < 4; ++c) {
        b.strain_increment[c * n + k] = c == 0 ? probe : 0;
        b.stress_old[c * n + k] = p.stress[c][first + k];
      }
    call_vumat(material, {0, 0, 1}, b);
    if (note_failure(first, b, blocks.failure_state, failed)) return;
    for (int k = 0; k < n; ++k) {
      const double modulus = (b.stress_new[k] - b.stress_old[k]) / probe;
      p.wave_speed[first + k] = std::sqrt(std::max(modulus, 0.0) / p.density[first + k]);
    }
  });
  if (failed < p.count) report_failure(p, material, Increment{0, 0, 1}, failed, blocks.spacing);
}

double damping_speed(const Numerics& numerics, double h, double wave_speed, double gradient_norm) {
  return std::min(0.5 * wave_speed,
                  numerics.viscosity * wave_speed + numerics.flow_viscosity * h * gradient_norm);
}

template <class Geometry>
void show_stress(const Particles<Geometry>& p, const Scene& scene, double smoothing_length,
                 Records<Geometry>& records) {
  const double weight_gradient = scene.bulk_density * scene.gravity;
  constexpr int D = Geometry::dimension;
#pragma omp parallel for schedule(static)
  for (int i = 0; i < p.count; ++i) {
    auto& record = records.stress[i];
    for (int a = 0; a < D; ++a) {
      record.position[a] = p.position[a][i];
      record.velocity[a] = p.velocity[a][i];
    }
    record.volume = records.motion[i].volume;
    record.weight = Geometry::weight(p.position[0][i]);
    record.density = p.density[i];
    double square = 0;
    for (int e = 0; e < D * D; ++e) {
      record.gradient[e] = p.velocity_gradient[e][i];
      square += record.gradient[e] * record.gradient[e];
    }
    record.damping_speed =
        damping_speed(scene.numerics, smoothing_length, p.wave_speed[i], std::sqrt(square));
    const double geostatic = weight_gradient * p.position[D - 1][i];
    for (int c = 0; c < Geometry::stress_components; ++c) {
      const double part = c >= 3 ? 0 : (c == D - 1 ? 1 : scene.earth_pressure_ratio);
      record.flux[c] = record.weight * p.stress[c][i];
      record.reduced_stress[c] = p.stress[c][i] - part * geostatic;
    }
  }
}

template StressBlocks make_stress_blocks(const Material&, const Particles<PlaneStrain>&, double);
template StressBlocks make_stress_blocks(const Material&, const Particles<Axisymmetric>&, double);
template void update_stress(Particles<PlaneStrain>&, const Material&, const Increment&, StressBlocks&);
template void update_stress(Particles<Axisymmetric>&, const Material&, const Increment&, StressBlocks&);
template void update_wave_speed(Particles<PlaneStrain>&, const Material&, StressBlocks&);
template void update_wave_speed(Particles<Axisymmetric>&, const Material&, StressBlocks&);
template void show_stress(const Particles<PlaneStrain>&, const Scene&, double, Records<PlaneStrain>&);
template void show_stress(const Particles<Axisymmetric>&, const Scene&, double, Records<Axisymmetric>&);

} // namespace host
