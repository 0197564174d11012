// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/passes.hpp"
#include "host/engine/gradient.hpp"
#include "host/engine/guard.hpp"
#include "host/engine/material_calls.hpp"
#include <algorithm>
#include <omp.h>

namespace host {
namespace {

/// Velocity gradients of the `count` particles first, first + 1, ...
template <class Geometry>
void find_gradients(const Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                    const NeighbourLists& lists, const Records<Geometry>& records, int first, int count,
                    BlockGradient<Geometry>& gradient) {
  constexpr int parts = Geometry::dimension * Geometry::dimension;
  for (int k = 0; k < count; k += lanes) {
    Lane slope[parts];
    find_gradient(p, kernel, lists, records, (first + k) / lanes, slope);
    for (int e = 0; e < parts; ++e) store(&gradient.component[e][k], slope[e]);
  }
}

/// Writes the stress records of a block. Returns the largest component of the gradients, 1/s, of those that are numbers.
template <class Geometry>
double write_block_records(Particles<Geometry>& p, const BlockGradient<Geometry>& gradient, int first,
                           int count, const Medium& medium, double h, Records<Geometry>& records) {
  ClusterGradient<Geometry> slope;
  Lane most{};
  for (int k = 0; k < count; k += lanes) {
    for (std::size_t e = 0; e < slope.size(); ++e) {
      slope[e] = load(&gradient.component[e][k]);
      most = larger(larger(slope[e], -slope[e]), most);
    }
    write_stress_records(p, first + k, std::min(lanes, count - k), slope, medium, h, records);
  }
  return largest(most);
}

} // namespace

template <class Geometry>
double deform(Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel, const NeighbourLists& lists,
              const Medium& medium, const Material& material, const Increment& increment,
              StressBlocks& blocks, Records<Geometry>& records) {
  const double start = increment.total_time - increment.dt;
  FirstFailure failure;
  for_each_block(p, material, blocks, [&](int first, VumatBlock& b) {
    BlockGradient<Geometry> gradient;
    find_gradients(p, kernel, lists, records, first, b.points, gradient);
    check_strain(p, gradient, first, b.points, start, increment.dt);
    advance_stress(p, material, increment, blocks, gradient, first, b, failure);
    blocks.largest_gradient[first / StressBlocks::points] =
        write_block_records(p, gradient, first, b.points, medium, kernel.h, records);
  });
  if (failure.bad) report_failure(p, material, failure, blocks.failure_state);
  return std::ranges::max(blocks.largest_gradient);
}

template <class Geometry>
Motion move(Particles<Geometry>& p, const Medium& medium, const MotionTerms<Geometry>& terms,
            MotionBuffers<Geometry::dimension>& buffers, std::vector<WallLoad>& loads) {
  constexpr int together = StressBlocks::points / lanes; // as in `deform`: what a thread has at hand
  const int blocks = (p.clusters() + together - 1) / together;
  const std::size_t walls = loads.size();
  buffers.threads.resize(std::size_t(omp_get_max_threads()));
  for (auto& buffer : buffers.threads) {
    buffer.near.reserve(terms.walls.before.size());
    buffer.shares.reserve(terms.walls.before.size());
  }
  buffers.motion.assign(blocks, {});
  buffers.loads.assign(blocks * walls, {});
#pragma omp parallel for schedule(static)
  for (int b = 0; b < blocks; ++b) {
    const auto block_loads = std::span(buffers.loads).subspan(b * walls, walls);
    for (int c = b * together; c < std::min((b + 1) * together, p.clusters()); ++c) {
      const auto forces = forces_on(p, terms.pairs.kernel, terms.pairs.lists, terms.pairs.records, medium, c);
      move_cluster(terms, forces, c, p, buffers.motion[b], block_loads,
                   buffers.threads[omp_get_thread_num()]);
      for (std::size_t s = 0; s < p.stress.size(); ++s) {
        double* stress = &p.stress[s][c * lanes];
        store(stress, load(stress) + terms.times.dt * forces.diffusion[s],
              std::min(lanes, p.count - c * lanes));
      }
    }
  }
  Motion all;
  for (int b = 0; b < blocks; ++b) {
    all.add(buffers.motion[b]);
    for (std::size_t w = 0; w < walls; ++w) loads[w].add(buffers.loads[b * walls + w]);
  }
  return all;
}

template decltype(deform<PlaneStrain>) deform<PlaneStrain>;
template decltype(deform<Axisymmetric>) deform<Axisymmetric>;
template decltype(deform<ThreeDimensional>) deform<ThreeDimensional>;
template decltype(move<PlaneStrain>) move<PlaneStrain>;
template decltype(move<Axisymmetric>) move<Axisymmetric>;
template decltype(move<ThreeDimensional>) move<ThreeDimensional>;

} // namespace host
