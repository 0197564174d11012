// SPDX-License-Identifier: BSD-3-Clause
// How the engine calls the material for all particles: it fills blocks, shares them out between threads and collects
// failures. For the sources of stress and wave speed.
#pragma once
#include "host/engine/first_error.hpp"
#include "host/engine/guard.hpp"
#include "host/engine/stress.hpp"
#include "host/material/reproducer.hpp"
#include "host/scheme/geometry.hpp"
#include <fmt/format.h>
#include <mutex>
#include <omp.h>
#include <optional>
#include <stdexcept>

namespace host {

template <class Geometry>
std::array<double, Geometry::stress_components> stress_of(const Particles<Geometry>& p, int i) {
  std::array<double, Geometry::stress_components> stress;
  for (std::size_t c = 0; c < stress.size(); ++c) stress[c] = p.stress[c][i];
  return stress;
}

/// Sets the inputs of particle i at point k of the block, all but strain, stress and state.
template <class Geometry>
void pack_point(const Particles<Geometry>& p, int i, int k, double spacing, VumatBlock& b) {
  for (int a = 0; a < Geometry::dimension; ++a) b.coordinates[a * b.points + k] = p.position[a][i];
  b.elements[k] = p.id[i] + 1;
  b.char_length[k] = spacing;
  b.density[k] = p.density[i];
  b.internal_energy_old[k] = p.internal_energy[i];
  b.inelastic_energy_old[k] = p.inelastic_energy[i];
}

/// Sets the inputs of particles first, first + 1, ..., all but strain and stress.
template <class Geometry> void pack(const Particles<Geometry>& p, int first, double spacing, VumatBlock& b) {
  const int n = b.points;
  for (int a = 0; a < Geometry::dimension; ++a) std::copy_n(&p.position[a][first], n, &b.coordinates[a * n]);
  for (int k = 0; k < n; ++k) b.elements[k] = p.id[first + k] + 1;
  std::fill_n(b.char_length.begin(), n, spacing);
  std::copy_n(&p.density[first], n, b.density.begin());
  std::copy_n(&p.internal_energy[first], n, b.internal_energy_old.begin());
  std::copy_n(&p.inelastic_energy[first], n, b.inelastic_energy_old.begin());
  for (int s = 0; s < b.state_variables; ++s) std::copy_n(&p.state[s][first], n, &b.state_old[s * n]);
}

/// The failure of the particle that comes first, with the inputs of its call: the same for any number of threads.
struct FirstFailure {
  std::mutex mutex;
  int particle = std::numeric_limits<int>::max();
  std::optional<BadAnswer> bad;
};

/// Looks for a failure in the results of a block and keeps it if its particle comes first; `particle(k)` is that of point
/// k. False if the block has none.
template <class ParticleOf>
bool note_failure(ParticleOf&& particle, const Material& material, const Increment& increment,
                  const VumatBlock& b, int failure_state, FirstFailure& failure) {
  const int k = first_failure(b, failure_state);
  if (k < 0) return false;
  const std::scoped_lock lock(failure.mutex);
  if (particle(k) < failure.particle) {
    failure.particle = particle(k);
    failure.bad = BadAnswer{fault_of(b, k, failure_state), point_call(material, increment, b, k)};
  }
  return true;
}

/// Calls `f(first, block)` for all particles, each thread with a block of its own, or in order if the material allows one
/// call at a time only. In two dimensions threads take blocks in turn, so that each gets flowing and resting sand; in
/// three they take contiguous ones, which share fewer neighbours. The exception of the first block that fails is thrown
/// on, with the first particle of this block in its message.
template <class Geometry, class F>
void for_each_block(const Particles<Geometry>& p, const Material& material, StressBlocks& blocks, F&& f) {
  const int full = p.count / StressBlocks::points, all = full + int(blocks.tail.size());
  FirstError error;
  const auto guarded = [&](int first, VumatBlock& block) {
    error.guarded(first, [&] {
      try {
        f(first, block);
      } catch (const UnstableMotion&) {
        throw;
      } catch (const std::runtime_error& what) {
        throw std::runtime_error(
            fmt::format("{}, in the block of {} from particle {}", what.what(), block.points, p.id[first]));
      }
    });
  };
  const int threads = omp_get_max_threads();
  const int together = Geometry::dimension == 3 ? (all + threads - 1) / threads : 1;
#pragma omp parallel for schedule(static, together) if (!material.serial)
  for (int b = 0; b < all; ++b)
    guarded(b * StressBlocks::points, b < full ? blocks.full[omp_get_thread_num()] : blocks.tail.front());
  error.rethrow();
}

/// Throws std::runtime_error with particle, time, stress and strain increment, and writes the call to a file that can be
/// replayed.
template <class Geometry>
[[noreturn]] void report_failure(const Particles<Geometry>& p, const Material& material,
                                 const FirstFailure& failure, int failure_state) {
  const std::filesystem::path folder = material.job.folder;
  throw std::runtime_error(
      evidence_of(material, failure_state, *failure.bad, fmt::format("particle {}", p.id[failure.particle]),
                  Geometry::dimension, folder.empty() ? folder : folder / "failed_point.toml"));
}

} // namespace host
