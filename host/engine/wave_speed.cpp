// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/material_calls.hpp"
#include "host/material/corotational.hpp"
#include "host/scheme/lane.hpp"

namespace host {
namespace {

constexpr double probe = -1e-6; // strain: a compression, since grains part in an extension
constexpr Increment data_check{0, 0, 1};

/// Lists the particles whose wave speed is outdated: those whose stress has changed by more than the tolerance since it was
/// found, and in each step one cluster of every sixteen. Where waves are too slow to limit the step, a change of a
/// tenth is small enough, since a modulus grows at most with the stress.
template <class Geometry> void find_outdated(const Particles<Geometry>& p, long step, StressBlocks& blocks) {
  constexpr int period = 16;
  constexpr double slower = 0.9, small = 0.1; // of the fastest wave; change of stress
  const double tight = blocks.wave_speed_tolerance, loose = std::max(tight, small);
  Lane most{};
  for (int c = 0; c < p.clusters(); ++c) most = larger(load(&p.wave_speed[c * lanes]), most);
  const double slow = slower * largest(most);
  blocks.outdated.clear();
  blocks.outdated.reserve(p.count); // a step asks for no memory
  for (int c = 0; c < p.clusters(); ++c) {
    Lane square{};
    for (const auto& stress : p.stress) {
      const Lane s = load(&stress[c * lanes]);
      square += s * s;
    }
    const Lane last = load(&p.checked_square[c * lanes]), speed = load(&p.wave_speed[c * lanes]);
    const Lane change = speed < slow ? Lane{} + loose : Lane{} + tight;
    const auto changed =
        (square > (1.0 + change) * (1.0 + change) * last) | (square < (1.0 - change) * (1.0 - change) * last);
    const bool all = (c + step) % period == 0;
    if (!all && !any(changed)) continue;
    for (int l = 0; l < lanes; ++l)
      if ((all || changed[l]) && c * lanes + l < p.count) blocks.outdated.push_back(c * lanes + l);
  }
}

/// Sets strain and old stress of point k for a data check of particle i.
template <class Geometry> void set_probe(const Particles<Geometry>& p, int i, int k, VumatBlock& b) {
  for (int c = 0; c < Geometry::stress_components; ++c) {
    b.strain_increment[c * b.points + k] = c == 0 ? probe : 0;
    b.stress_old[c * b.points + k] = p.stress[c][i];
  }
}

/// Wave speed of particle i from the new stress of point k.
template <class Geometry> void take_wave_speed(const VumatBlock& b, int k, Particles<Geometry>& p, int i) {
  const double modulus = (b.stress_new[k] - p.stress[0][i]) / probe;
  p.wave_speed[i] = std::sqrt(std::max(modulus, 0.0) / p.density[i]);
  p.checked_square[i] = 0;
  for (const auto& stress : p.stress) p.checked_square[i] += stress[i] * stress[i];
}

/// Finds the wave speeds that are outdated. The last block is filled up by repeating its last particle.
template <class Geometry>
void update_outdated(Particles<Geometry>& p, const Material& material, StressBlocks& blocks,
                     FirstFailure& failure) {
  const int count = int(blocks.outdated.size()), n = StressBlocks::points;
  FirstError error;
#pragma omp parallel for schedule(static) if (!material.serial)
  for (int first = 0; first < count; first += n)
    error.guarded(first, [&] {
      VumatBlock& b = blocks.full[omp_get_thread_num()];
      const auto particle = [&](int k) { return blocks.outdated[std::min(first + k, count - 1)]; };
      for (int k = 0; k < n; ++k) {
        const int i = particle(k);
        pack_point(p, i, k, blocks.spacing, b);
        for (int s = 0; s < b.state_variables; ++s) b.state_old[s * n + k] = p.state[s][i];
        set_probe(p, i, k, b);
      }
      call_vumat(material, data_check, b);
      if (note_failure(particle, material, data_check, b, blocks.failure_state, failure)) return;
      for (int k = 0; k < n && first + k < count; ++k) take_wave_speed(b, k, p, particle(k));
    });
  error.rethrow();
}

template <class Geometry>
void update_all(Particles<Geometry>& p, const Material& material, StressBlocks& blocks,
                FirstFailure& failure) {
  const bool corotational = material.frame == Frame::green_naghdi;
  for_each_block(p, material, blocks, [&](int first, VumatBlock& b) {
    pack(p, first, blocks.spacing, b);
    for (int k = 0; k < b.points; ++k) set_probe(p, first + k, k, b);
    if (corotational) enter_corotational(p, BlockGradient<Geometry>{}, first, 0, b);
    call_vumat(material, data_check, b);
    const auto particle = [=](int k) { return first + k; };
    if (note_failure(particle, material, data_check, b, blocks.failure_state, failure)) return;
    if (corotational) leave_corotational(b);
    for (int k = 0; k < b.points; ++k) take_wave_speed(b, k, p, particle(k));
  });
}

} // namespace

template <class Geometry>
void update_wave_speed(Particles<Geometry>& p, const Material& material, StressBlocks& blocks, long step) {
  FirstFailure failure;
  if (blocks.wave_speed_tolerance > 0 && step > 0 && material.frame != Frame::green_naghdi) {
    find_outdated(p, step, blocks);
    update_outdated(p, material, blocks, failure);
  } else
    update_all(p, material, blocks, failure);
  if (failure.bad) report_failure(p, material, failure, blocks.failure_state);
}

template decltype(update_wave_speed<PlaneStrain>) update_wave_speed<PlaneStrain>;
template decltype(update_wave_speed<Axisymmetric>) update_wave_speed<Axisymmetric>;
template decltype(update_wave_speed<ThreeDimensional>) update_wave_speed<ThreeDimensional>;

} // namespace host
