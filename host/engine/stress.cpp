// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/stress.hpp"
#include "host/engine/material_calls.hpp"
#include "host/material/corotational.hpp"
#include "host/scheme/damping.hpp"
#include "host/scheme/rotation.hpp"
#include "host/scheme/strain.hpp"

namespace host {

template <class Geometry>
StressBlocks make_stress_blocks(const Material& material, const Particles<Geometry>& p, double spacing) {
  StressBlocks blocks;
  blocks.spacing = spacing;
  blocks.full.assign(omp_get_max_threads(),
                     VumatBlock(material, StressBlocks::points, Geometry::shear_components));
  if (const int left = p.count % StressBlocks::points)
    blocks.tail.emplace_back(material, left, Geometry::shear_components);
  blocks.largest_gradient.assign((p.count + StressBlocks::points - 1) / StressBlocks::points, 0);
  return blocks;
}

namespace {

/// Particles under no load and of less than the density `limit`, kg/m3: grains that have left the sand. Their few
/// neighbours pass by at other speeds, and the gradient of these would make their volume drift, up to a hundred times
/// that of the sand, with which they would push walls and neighbours away.
template <std::size_t S>
auto is_dispersed(const Lane& density, const Lane& wave_speed, const std::array<Lane, S>& stress,
                  double limit) {
  constexpr double no_load = 1e-3; // of the constrained modulus
  const Lane pressure = -(stress[0] + stress[1] + stress[2]) / 3;
  return density < limit && pressure >= 0.0 && pressure <= no_load * density * wave_speed * wave_speed;
}

/// Sets strain increments, rotated old stress and densities of particles first, first + 1, ... and advances their
/// density. Dispersed particles do not expand.
template <class Geometry>
void strain_block(Particles<Geometry>& p, const BlockGradient<Geometry>& gradient, int first, double dt,
                  const StressBlocks& blocks, bool rotates, VumatBlock& b) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  constexpr int directions = Geometry::hoop ? 3 : D; // with strain
  for (int k = 0; k < b.points; k += lanes) {
    const int i = first + k, used = std::min(lanes, b.points - k);
    std::array<Lane, D * D> slope;
    std::array<Lane, S> stress;
    for (int e = 0; e < D * D; ++e) slope[e] = load(&gradient.component[e][k]);
    for (int c = 0; c < S; ++c) stress[c] = load(&p.stress[c][i]);
    const auto step = strain_increment<Geometry>(slope, load(&p.position[0][i]), load(&p.velocity[0][i]), dt,
                                                 blocks.spacing);
    if (rotates) stress = rotated(stress, step.angle);
    const Lane density = load(&p.density[i]);
    Lane volumetric = step.strain[0] + step.strain[1] + step.strain[2];
    const Lane expansion = is_dispersed(density, load(&p.wave_speed[i]), stress, blocks.dispersed_density)
                               ? larger(volumetric, Lane{})
                               : Lane{};
    volumetric -= expansion;
    for (int c = 0; c < S; ++c) {
      store(&b.strain_increment[c * b.points + k],
            c < directions ? step.strain[c] - expansion / directions : step.strain[c], used);
      store(&b.stress_old[c * b.points + k], stress[c], used);
    }
    store(&b.density[k], density * (1 - 0.25 * volumetric) / (1 + 0.25 * volumetric), used); // mid-increment
    store(&p.density[i], density * (1 - 0.5 * volumetric) / (1 + 0.5 * volumetric),
          used); // exp(-volumetric) to third order
  }
}

/// Takes over stress, state and energies after a call.
template <class Geometry> void take_results(const VumatBlock& b, int first, Particles<Geometry>& p) {
  const int n = b.points;
  for (int c = 0; c < Geometry::stress_components; ++c)
    std::copy_n(&b.stress_new[c * n], n, &p.stress[c][first]);
  for (int s = 0; s < b.state_variables; ++s) std::copy_n(&b.state_new[s * n], n, &p.state[s][first]);
  std::copy_n(b.internal_energy_new.begin(), n, &p.internal_energy[first]);
  std::copy_n(b.inelastic_energy_new.begin(), n, &p.inelastic_energy[first]);
}

} // namespace

template <class Geometry>
void advance_stress(Particles<Geometry>& p, const Material& material, const Increment& increment,
                    const StressBlocks& blocks, const BlockGradient<Geometry>& gradient, int first,
                    VumatBlock& b, FirstFailure& failure) {
  const bool corotational = material.frame == Frame::green_naghdi;
  pack(p, first, blocks.spacing, b);
  strain_block(p, gradient, first, increment.dt, blocks, !corotational, b);
  if (corotational) enter_corotational(p, gradient, first, increment.dt, b);
  call_vumat(material, increment, b);
  if (note_failure([=](int k) { return first + k; }, material, increment, b, blocks.failure_state, failure))
    return;
  if (corotational) {
    leave_corotational(b);
    keep_deformation(b, first, p);
  }
  take_results(b, first, p);
}

template <class Geometry>
void write_stress_records(Particles<Geometry>& p, int first, int used,
                          const ClusterGradient<Geometry>& gradient, const Medium& medium, double h,
                          Records<Geometry>& records) {
  constexpr int D = Geometry::dimension, rates = D * (D + 1) / 2;
  Lane square{}, rate[rates];
  for (const Lane& g : gradient) square += g * g;
  for (int c = 0; c < rates; ++c) {
    const int a = first_axis<D>(c), b = second_axis<D>(c);
    rate[c] = a == b ? gradient[a * D + a] : gradient[a * D + b] + gradient[b * D + a];
  }
  const Lane norm = square_root(square), wave_speed = load(&p.wave_speed[first]);
  const Lane damping = damping_speed(medium, h, wave_speed, norm);
  store(&p.diffusivity[first], stress_diffusivity(medium, h, wave_speed, norm));
  for (int l = 0; l < used; ++l) {
    auto& record = records.stress[first + l];
    for (int c = 0; c < Geometry::stress_components; ++c) record.stress[c] = p.stress[c][first + l];
    for (int c = 0; c < rates; ++c) record.strain_rate[c] = float(rate[c][l]);
    record.density = float(p.density[first + l]);
    record.damping_speed = float(damping[l]);
  }
}

template decltype(make_stress_blocks<PlaneStrain>) make_stress_blocks<PlaneStrain>;
template decltype(make_stress_blocks<Axisymmetric>) make_stress_blocks<Axisymmetric>;
template decltype(make_stress_blocks<ThreeDimensional>) make_stress_blocks<ThreeDimensional>;
template decltype(advance_stress<PlaneStrain>) advance_stress<PlaneStrain>;
template decltype(advance_stress<Axisymmetric>) advance_stress<Axisymmetric>;
template decltype(advance_stress<ThreeDimensional>) advance_stress<ThreeDimensional>;
template decltype(write_stress_records<PlaneStrain>) write_stress_records<PlaneStrain>;
template decltype(write_stress_records<Axisymmetric>) write_stress_records<Axisymmetric>;
template decltype(write_stress_records<ThreeDimensional>) write_stress_records<ThreeDimensional>;

} // namespace host
