// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/stress.hpp"
#include "host/engine/material_calls.hpp"
#include "host/material/corotational.hpp"
#include "host/scheme/rotation.hpp"

namespace host {

template <class Geometry>
StressBlocks make_stress_blocks(const Material& material, const Particles<Geometry>& p, double spacing) {
  StressBlocks blocks;
  blocks.spacing = spacing;
  blocks.full.assign(omp_get_max_threads(),
                     VumatBlock(material, StressBlocks::points, Geometry::shear_components));
  if (const int left = p.count % StressBlocks::points)
    blocks.tail.emplace_back(material, left, Geometry::shear_components);
  blocks.steepest.assign((p.count + StressBlocks::points - 1) / StressBlocks::points, 0);
  return blocks;
}

namespace {

/// Particles that bear next to nothing, at less than the density `loosest`: thrown off. Nothing there holds a volume
/// to be strained; its density would drift with what passes by, down to a hundredth of the sand's, and push walls
/// and neighbours away as if the particle filled all of it.
template <std::size_t S>
auto is_thrown_off(const Lane& density, const Lane& wave_speed, const std::array<Lane, S>& stress,
                   double loosest) {
  constexpr double nothing = 1e-3; // of the constrained modulus
  const Lane pressure = -(stress[0] + stress[1] + stress[2]) / 3;
  return density < loosest && pressure >= 0.0 && pressure <= nothing * density * wave_speed * wave_speed;
}

/// Strain increments, turned old stress and densities of particles first, first + 1, ...; density is advanced. What is
/// thrown off is not strained to a larger volume.
template <class Geometry>
void strain_block(Particles<Geometry>& p, const BlockGradient<Geometry>& gradient, int first, double dt,
                  const StressBlocks& blocks, bool turning, VumatBlock& b) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  constexpr int directions = Geometry::hoop ? 3 : D; // that strain
  for (int k = 0; k < b.points; k += lanes) {
    const int i = first + k, used = std::min(lanes, b.points - k);
    std::array<Lane, D * D> slope;
    std::array<Lane, S> stress;
    for (int e = 0; e < D * D; ++e) slope[e] = load(&gradient.component[e][k]);
    for (int c = 0; c < S; ++c) stress[c] = load(&p.stress[c][i]);
    const auto step =
        step_strain<Geometry>(slope, load(&p.position[0][i]), load(&p.velocity[0][i]), dt, blocks.spacing);
    if (turning) stress = turned(stress, step.angle);
    const Lane density = load(&p.density[i]);
    Lane volumetric = step.strain[0] + step.strain[1] + step.strain[2];
    const Lane spread = is_thrown_off(density, load(&p.wave_speed[i]), stress, blocks.loosest)
                            ? larger(volumetric, Lane{})
                            : Lane{};
    volumetric -= spread;
    for (int c = 0; c < S; ++c) {
      store(&b.strain_increment[c * b.points + k],
            c < directions ? step.strain[c] - spread / directions : step.strain[c], used);
      store(&b.stress_old[c * b.points + k], stress[c], used);
    }
    store(&b.density[k], density * (1 - 0.25 * volumetric) / (1 + 0.25 * volumetric), used); // mid-increment
    store(&p.density[i], density * (1 - 0.5 * volumetric) / (1 + 0.5 * volumetric),
          used); // exp(-volumetric) to third order
  }
}

/// Stress, state and energies after a call.
template <class Geometry> void keep_answer(const VumatBlock& b, int first, Particles<Geometry>& p) {
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
                    VumatBlock& b, Failure& failure) {
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
  keep_answer(b, first, p);
}

template <class Geometry>
void update_stress(Particles<Geometry>& p, const Material& material, const Increment& increment,
                   StressBlocks& blocks) {
  Failure failure;
  for_each_block(p, material, blocks, [&](int first, VumatBlock& b) {
    BlockGradient<Geometry> gradient{};
    for (std::size_t e = 0; e < p.velocity_gradient.size(); ++e)
      std::copy_n(&p.velocity_gradient[e][first], b.points, gradient.component[e]);
    for (int c = 0; c < Geometry::stress_components; ++c)
      for (int i = first; i < first + b.points; ++i)
        p.stress[c][i] += p.stress_diffusion[c][i] * increment.dt;
    advance_stress(p, material, increment, blocks, gradient, first, b, failure);
  });
  if (failure.bad) report_failure(p, material, failure, blocks.failure_state);
}

/// Diffusivity of stress, m2/s: delta h2 |grad v|, so that noise is smoothed as it arises, by strain, and a
/// deposit at rest keeps its stress; at most 0.1 h c, where it would limit the step.
static Lane stress_diffusivity(double delta, double h, const Lane& wave_speed, const Lane& gradient_norm) {
  return smaller(delta * h * h * gradient_norm, 0.1 * h * wave_speed);
}

template <class Geometry>
void show_stress_of(Particles<Geometry>& p, int first, int used, const ClusterGradient<Geometry>& gradient,
                    const Numerics& numerics, double h, Records<Geometry>& records) {
  constexpr int D = Geometry::dimension, rates = D * (D + 1) / 2;
  Lane square{}, rate[rates];
  for (const Lane& g : gradient) square += g * g;
  for (int c = 0; c < rates; ++c) {
    const int a = first_axis<D>(c), b = second_axis<D>(c);
    rate[c] = a == b ? gradient[a * D + a] : gradient[a * D + b] + gradient[b * D + a];
  }
  const Lane norm = square_root(square), wave_speed = load(&p.wave_speed[first]);
  const Lane damping = damping_speed(numerics, h, wave_speed, norm);
  store(&p.diffusivity[first], stress_diffusivity(numerics.stress_diffusion, h, wave_speed, norm));
  for (int l = 0; l < used; ++l) {
    auto& record = records.stress[first + l];
    for (int c = 0; c < Geometry::stress_components; ++c) record.stress[c] = p.stress[c][first + l];
    for (int c = 0; c < rates; ++c) record.strain_rate[c] = float(rate[c][l]);
    record.density = float(p.density[first + l]);
    record.damping_speed = float(damping[l]);
  }
}

template <class Geometry>
void show_stress(Particles<Geometry>& p, const Scene& scene, double h, Records<Geometry>& records) {
#pragma omp parallel for schedule(static)
  for (int first = 0; first < p.count; first += lanes) {
    ClusterGradient<Geometry> gradient;
    for (std::size_t e = 0; e < gradient.size(); ++e) gradient[e] = load(&p.velocity_gradient[e][first]);
    show_stress_of(p, first, std::min(lanes, p.count - first), gradient, scene.numerics, h, records);
  }
}

template StressBlocks make_stress_blocks(const Material&, const Particles<PlaneStrain>&, double);
template void advance_stress(Particles<PlaneStrain>&, const Material&, const Increment&, const StressBlocks&,
                             const BlockGradient<PlaneStrain>&, int, VumatBlock&, Failure&);
template void update_stress(Particles<PlaneStrain>&, const Material&, const Increment&, StressBlocks&);
template void show_stress_of(Particles<PlaneStrain>&, int, int, const ClusterGradient<PlaneStrain>&,
                             const Numerics&, double, Records<PlaneStrain>&);
template void show_stress(Particles<PlaneStrain>&, const Scene&, double, Records<PlaneStrain>&);
template StressBlocks make_stress_blocks(const Material&, const Particles<Axisymmetric>&, double);
template void advance_stress(Particles<Axisymmetric>&, const Material&, const Increment&, const StressBlocks&,
                             const BlockGradient<Axisymmetric>&, int, VumatBlock&, Failure&);
template void update_stress(Particles<Axisymmetric>&, const Material&, const Increment&, StressBlocks&);
template void show_stress_of(Particles<Axisymmetric>&, int, int, const ClusterGradient<Axisymmetric>&,
                             const Numerics&, double, Records<Axisymmetric>&);
template void show_stress(Particles<Axisymmetric>&, const Scene&, double, Records<Axisymmetric>&);
template StressBlocks make_stress_blocks(const Material&, const Particles<ThreeDimensional>&, double);
template void advance_stress(Particles<ThreeDimensional>&, const Material&, const Increment&,
                             const StressBlocks&, const BlockGradient<ThreeDimensional>&, int, VumatBlock&,
                             Failure&);
template void update_stress(Particles<ThreeDimensional>&, const Material&, const Increment&, StressBlocks&);
template void show_stress_of(Particles<ThreeDimensional>&, int, int, const ClusterGradient<ThreeDimensional>&,
                             const Numerics&, double, Records<ThreeDimensional>&);
template void show_stress(Particles<ThreeDimensional>&, const Scene&, double, Records<ThreeDimensional>&);

} // namespace host
