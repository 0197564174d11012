// SPDX-License-Identifier: BSD-3-Clause
#include "host/stress.hpp"
#include "host/corotational.hpp"
#include "host/material_calls.hpp"
#include "host/rotation.hpp"

namespace host {

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
  const bool corotational = material.frame == Frame::green_naghdi;
  Failure failure;
  for_each_block(p, material, blocks, [&](int first, VumatBlock& b) {
    const int n = b.points;
    pack(p, first, blocks.spacing, b);
    for (int k = 0; k < n; ++k) {
      const int i = first + k;
      const auto step = step_strain(p, i, increment.dt, blocks.spacing);
      const auto old_stress = corotational ? stress_of(p, i) : turned(stress_of(p, i), step.angle);
      for (int c = 0; c < Geometry::stress_components; ++c) {
        b.strain_increment[c * n + k] = step.strain[c];
        b.stress_old[c * n + k] = old_stress[c] + p.stress_diffusion[c][i] * increment.dt;
      }
      const double volumetric = step.strain[0] + step.strain[1] + step.strain[2];
      b.density[k] = p.density[i] * (1 - 0.25 * volumetric) / (1 + 0.25 * volumetric); // mid-increment
      p.density[i] *= (1 - 0.5 * volumetric) / (1 + 0.5 * volumetric); // exp(-volumetric) to third order
    }
    if (corotational) enter_corotational(p, first, increment.dt, b);
    call_vumat(material, increment, b);
    if (note_failure([=](int k) { return first + k; }, material, increment, b, blocks.failure_state, failure))
      return;
    if (corotational) {
      leave_corotational(b);
      keep_deformation(b, first, p);
    }
    for (int c = 0; c < Geometry::stress_components; ++c)
      std::copy_n(&b.stress_new[c * n], n, &p.stress[c][first]);
    for (int s = 0; s < b.state_variables; ++s) std::copy_n(&b.state_new[s * n], n, &p.state[s][first]);
    std::copy_n(b.internal_energy_new.begin(), n, &p.internal_energy[first]);
    std::copy_n(b.inelastic_energy_new.begin(), n, &p.inelastic_energy[first]);
  });
  if (failure.call) report_failure(p, material, failure, blocks.failure_state);
}

double damping_speed(const Numerics& numerics, double h, double wave_speed, double gradient_norm) {
  return std::min(0.5 * wave_speed,
                  numerics.viscosity * wave_speed + numerics.flow_viscosity * h * gradient_norm);
}

namespace {

/// What a record holds beyond position, velocity, volume, density and damping: in two dimensions ...
template <class Geometry>
void show_weighted(const Particles<Geometry>& p, int i, const Scene& scene, StressRecord<Geometry>& record) {
  constexpr int D = Geometry::dimension;
  record.weight = Geometry::weight(p.position[0][i]);
  for (int e = 0; e < D * D; ++e) record.gradient[e] = p.velocity_gradient[e][i];
  const double geostatic = scene.bulk_density * scene.gravity * p.position[D - 1][i];
  for (int c = 0; c < Geometry::stress_components; ++c) {
    const double part = c >= 3 ? 0 : (c == D - 1 ? 1 : scene.earth_pressure_ratio);
    record.flux[c] = record.weight * p.stress[c][i];
    record.reduced_stress[c] = p.stress[c][i] - part * geostatic;
  }
}

/// ... and in three.
void show_solid(const Particles<ThreeDimensional>& p, int i, StressRecord<ThreeDimensional>& record) {
  const auto l = [&](int a, int b) { return p.velocity_gradient[3 * a + b][i]; };
  for (int c = 0; c < 6; ++c) record.flux[c] = p.stress[c][i];
  for (int a = 0; a < 3; ++a) {
    record.strain_rate[a] = l(a, a);
    record.strain_rate[3 + a] = l(a, (a + 1) % 3) + l((a + 1) % 3, a);
  }
}

} // namespace

template <class Geometry>
void show_stress(const Particles<Geometry>& p, const Scene& scene, double smoothing_length,
                 Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
#pragma omp parallel for schedule(static)
  for (int i = 0; i < p.count; ++i) {
    auto& record = records.stress[i];
    for (int a = 0; a < D; ++a) {
      record.position[a] = p.position[a][i];
      record.velocity[a] = p.velocity[a][i];
    }
    record.volume = records.motion[i].volume;
    record.density = p.density[i];
    double square = 0;
    for (int e = 0; e < D * D; ++e) square += p.velocity_gradient[e][i] * p.velocity_gradient[e][i];
    record.damping_speed =
        damping_speed(scene.numerics, smoothing_length, p.wave_speed[i], std::sqrt(square));
    if constexpr (D == 3)
      show_solid(p, i, record);
    else
      show_weighted(p, i, scene, record);
  }
}

template StressBlocks make_stress_blocks(const Material&, const Particles<PlaneStrain>&, double);
template StressBlocks make_stress_blocks(const Material&, const Particles<Axisymmetric>&, double);
template StressBlocks make_stress_blocks(const Material&, const Particles<ThreeDimensional>&, double);
template void update_stress(Particles<PlaneStrain>&, const Material&, const Increment&, StressBlocks&);
template void update_stress(Particles<Axisymmetric>&, const Material&, const Increment&, StressBlocks&);
template void update_stress(Particles<ThreeDimensional>&, const Material&, const Increment&, StressBlocks&);
template void show_stress(const Particles<PlaneStrain>&, const Scene&, double, Records<PlaneStrain>&);
template void show_stress(const Particles<Axisymmetric>&, const Scene&, double, Records<Axisymmetric>&);
template void show_stress(const Particles<ThreeDimensional>&, const Scene&, double,
                          Records<ThreeDimensional>&);

} // namespace host
