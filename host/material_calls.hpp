// SPDX-License-Identifier: BSD-3-Clause
// How the stages call the material for all particles: inputs into blocks, blocks to threads, failures collected.
// For the sources of stress and wave speed.
#pragma once
#include "host/first_error.hpp"
#include "host/geometry.hpp"
#include "host/guard.hpp"
#include "host/reproducer.hpp"
#include "host/stress.hpp"
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

/// Inputs of a call at point k of the block, all but strain, stress and state.
template <class Geometry>
void pack_point(const Particles<Geometry>& p, int i, int k, double spacing, VumatBlock& b) {
  for (int a = 0; a < Geometry::dimension; ++a) b.coordinates[a * b.points + k] = p.position[a][i];
  b.char_length[k] = spacing;
  b.density[k] = p.density[i];
  b.internal_energy_old[k] = p.internal_energy[i];
  b.inelastic_energy_old[k] = p.inelastic_energy[i];
}

/// Inputs of a call for particles first, first + 1, ...
template <class Geometry> void pack(const Particles<Geometry>& p, int first, double spacing, VumatBlock& b) {
  const int n = b.points;
  for (int a = 0; a < Geometry::dimension; ++a) std::copy_n(&p.position[a][first], n, &b.coordinates[a * n]);
  std::fill_n(b.char_length.begin(), n, spacing);
  std::copy_n(&p.density[first], n, b.density.begin());
  std::copy_n(&p.internal_energy[first], n, b.internal_energy_old.begin());
  std::copy_n(&p.inelastic_energy[first], n, b.inelastic_energy_old.begin());
  for (int s = 0; s < b.state_variables; ++s) std::copy_n(&p.state[s][first], n, &b.state_old[s * n]);
}

/// Index in the block of the first point whose answer is not finite or whose material reports a failure; -1 if
/// there is none.
inline int first_failure(const VumatBlock& b, int failure_state) {
  const auto whole = [](const GuardedArray& a) { // an exponent of ones: infinite or no number
    constexpr std::uint64_t ones = 0x7ff0000000000000;
    bool finite = true;
    for (const double x : a) finite &= (std::bit_cast<std::uint64_t>(x) & ones) != ones;
    return finite;
  };
  bool sound = whole(b.stress_new) && whole(b.state_new) && whole(b.internal_energy_new) &&
               whole(b.inelastic_energy_new);
  if (failure_state >= 0)
    for (int k = 0; k < b.points; ++k) sound &= !(b.state_new[failure_state * b.points + k] < 0);
  if (sound) return -1;
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

/// The failure of the particle that comes first, with what its material was called with.
struct Failure {
  std::mutex mutex;
  int particle = std::numeric_limits<int>::max();
  std::string fault;
  std::optional<PointCall> call;
};

/// Keeps the failure of the particle that comes first; `particle(k)` is that of point k. False if the block has
/// none.
template <class ParticleOf>
bool note_failure(ParticleOf&& particle, const Material& material, const Increment& increment,
                  const VumatBlock& b, int failure_state, Failure& failure) {
  const int k = first_failure(b, failure_state);
  if (k < 0) return false;
  const std::scoped_lock lock(failure.mutex);
  if (particle(k) < failure.particle) {
    failure.particle = particle(k);
    failure.fault = fault_of(b, k, failure_state);
    failure.call = point_call(material, increment, b, k);
  }
  return true;
}

/// Calls `f(first, block)` for all particles, each thread with a block of its own; in order where the material
/// wants one call at a time. Threads take blocks in turn, so that flowing and resting parts fall to all alike. An
/// exception comes out with the first particle of its block.
template <class Geometry, class F>
void for_each_block(const Particles<Geometry>& p, const Material& material, StressBlocks& blocks, F&& f) {
  const int full = p.count / StressBlocks::points, all = full + int(blocks.tail.size());
  FirstError error;
  const auto guarded = [&](int first, VumatBlock& block) {
    error.guarded(first, [&] {
      try {
        f(first, block);
      } catch (const UnsoundMotion&) {
        throw;
      } catch (const std::runtime_error& what) {
        throw std::runtime_error(
            fmt::format("{}, in the block of {} from particle {}", what.what(), block.points, p.id[first]));
      }
    });
  };
#pragma omp parallel for schedule(static, 1) if (!material.serial)
  for (int b = 0; b < all; ++b)
    guarded(b * StressBlocks::points, b < full ? blocks.full[omp_get_thread_num()] : blocks.tail.front());
  error.rethrow();
}

/// "(a, b, ...)" with six or nine digits.
inline std::string listed(const GuardedArray& a, int digits) {
  std::string text;
  for (const double x : a) text += fmt::format("{}{:.{}g}", text.empty() ? "" : ", ", x, digits);
  return "(" + text + ")";
}

template <class Geometry>
[[noreturn]] void report_failure(const Particles<Geometry>& p, const Material& material,
                                 const Failure& failure, int failure_state) {
  const auto& [increment, point] = *failure.call;
  std::string position;
  for (int a = 0; a < Geometry::dimension; ++a)
    position += fmt::format("{}{:.6g}", a ? ", " : "", point.coordinates[a]);
  const auto what = fmt::format("material {} {}: particle {} at time {:.9g} s, position ({}) m, stress "
                                "before {} Pa, strain increment {}",
                                material.name, failure.fault, p.id[failure.particle], increment.total_time,
                                position, listed(point.stress_old, 9), listed(point.strain_increment, 6));
  throw std::runtime_error(what +
                           write_reproducer(reproducer_text(material, failure_state, *failure.call, what)));
}

} // namespace host
