// SPDX-License-Identifier: BSD-3-Clause
// What a step costs: `host_rate SCENE.toml [TIME [BATCHES]]` leads a scene of any geometry to TIME (s), then runs
// batches of steps and prints the time of each stage for a particle, its flops and bytes, and their share of what this
// kind of machine can do; then the whole step, the material's part in it, and the memory of a particle. The whole is
// processor time, so that other programs disturb little; the stages are its shares. One thread.
//
// Flops are counted in the source, for all entries of the lists, since an entry is computed for all eight particles;
// additions, multiplications, square roots and divisions one each. Those of the material are not counted. Bytes
// are those of the arrays that a stage reads and writes for a particle, and for pairs of the neighbours' records.
#include "drivers/files/scene_file.hpp"
#include "host/engine/gradient.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/benchmark/peaks.hpp"
#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <fmt/format.h>
#include <iostream>
#include <omp.h>
#include <utility>
#include <vector>

namespace {

using namespace host;

double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Pairs within the support and entries of the lists, for each particle; an entry is computed for all eight.
struct Pairs {
  double close = 0, listed = 0;
};
template <class Geometry> Pairs count_pairs(const Simulation<Geometry>& s) {
  Pairs pairs;
  const auto& p = s.particles;
  for (int c = 0; c < p.clusters(); ++c) {
    pairs.listed += double(lanes) * s.lists.total[c] / p.count;
    for (int i = c * lanes; i < std::min((c + 1) * lanes, p.count); ++i)
      for (int k = 0; k < s.lists.total[c]; ++k) {
        const auto& x = s.records.motion[s.lists.begin(c)[k]].position;
        double square = 0;
        for (int a = 0; a < Geometry::dimension; ++a) square += std::pow(x[a] - p.position[a][i], 2);
        pairs.close += (square < s.kernel.support * s.kernel.support) / double(p.count);
      }
  }
  return pairs;
}

/// What a stage of the step is known to do for each particle.
struct Counts {
  double flops = 0; ///< 0: not counted
  double bytes = 0;
};

/// In the order of `Stage`. A list is read and a neighbour's record loaded once for the eight particles of a cluster.
template <class Geometry>
std::array<Counts, stage_names.size()> counts_of(const Simulation<Geometry>& s, const Pairs& pairs) {
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  constexpr double motion = sizeof(MotionRecord<D>), stress = sizeof(StressRecord<Geometry>), real = 8;
  const double answer = S + double(s.particles.state.size()) + 2; // numbers that a material changes
  const double images = double(s.images.list.size()) / s.particles.count;
  const double records = 1 + 2 * images; // one written for each particle, one read and written for each image
  return {Counts{3, (2 * D + 2) * real + motion * records}, Counts{0, (S + 2) * real},
          Counts{gradient_flops<D> * pairs.listed + 4 * D * D,
                 (2 * D + 2 * answer + 4) * real + (motion + 4) * pairs.listed / lanes + stress * records},
          Counts{pair_flops<Geometry> * pairs.listed + 20 * D,
                 (2 * S + 3 + 4 * D) * real + (motion + stress + 4) * pairs.listed / lanes}};
}

/// Forwards to a subroutine and adds up its time.
template <class> struct Timed;
template <class... A> struct Timed<void(A...)> {
  static inline void (*subroutine)(A...) = nullptr;
  static inline double seconds = 0;
  static void call(A... a) {
    const auto start = std::chrono::steady_clock::now();
    subroutine(a...);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
};
using TimedVumat = Timed<vumat::Subroutine<double>>;

/// Seconds of `count` steps: of processor time for the whole, by the clock for the stages and the material.
struct Measured {
  double whole = 0, elapsed = 0, material = 0;
  std::array<double, stage_names.size()> stage{};
};
template <class Geometry> Measured measure_steps(Simulation<Geometry>& s, int count) {
  Measured m;
  s.stage_seconds = {};
  TimedVumat::seconds = 0;
  const double start = processor_seconds();
  const auto clock = std::chrono::steady_clock::now();
  for (int k = 0; k < count; ++k) step(s);
  m.whole = processor_seconds() - start;
  m.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  m.stage = s.stage_seconds;
  m.material = TimedVumat::seconds;
  return m;
}

/// Whole of the batch with the median processor time; shares of the stages by the clock in all batches together, so
/// that the parts sum to the whole.
template <class Geometry> Measured measure(Simulation<Geometry>& s, int batches, int count) {
  auto& call = s.scene.material.library.call;
  TimedVumat::subroutine = std::exchange(call, TimedVumat::call);
  std::vector<double> wholes;
  Measured sum;
  for (int k = 0; k < batches; ++k) {
    const auto m = measure_steps(s, count);
    wholes.push_back(m.whole);
    sum.elapsed += m.elapsed;
    sum.material += m.material;
    for (std::size_t stage = 0; stage < m.stage.size(); ++stage) sum.stage[stage] += m.stage[stage];
  }
  call = TimedVumat::subroutine;
  std::ranges::nth_element(wholes, wholes.begin() + batches / 2);
  sum.whole = wholes[batches / 2] / count;
  for (double& seconds : sum.stage) seconds *= sum.whole / sum.elapsed;
  sum.material *= sum.whole / sum.elapsed;
  return sum;
}

void print_row(const char* name, double seconds, const Counts& counts, const tests::Peaks& peaks) {
  fmt::print("{:<20}{:>12.1f}", name, 1e9 * seconds);
  if (counts.flops > 0)
    fmt::print("{:>14.0f}{:>10.0f}", counts.flops, 100 * counts.flops / seconds / peaks.flops);
  else
    fmt::print("{:>14}{:>10}", "-", "-");
  fmt::print("{:>14.0f}{:>10.0f}\n", counts.bytes, 100 * counts.bytes / seconds / peaks.bytes);
}

template <class Geometry> void print_measured(Simulation<Geometry>& s, int batches) {
  const double count = s.particles.count;
  const auto peaks = tests::measured_peaks();
  fmt::print("peaks of a core, measured: {:.0f} GFlop/s, {:.0f} GB/s\n", 1e-9 * peaks.flops,
             1e-9 * peaks.bytes);
  const auto m = measure(s, batches, std::max(1, int(2e4 / count)));
  const auto pairs = count_pairs(s);
  fmt::print(
      "{} particles, {} images; {:.1f} neighbours within the support, {:.1f} computed, {} rebuilds and "
      "{} prunings in {} steps\n{:<20}{:>12}{:>14}{:>10}{:>14}{:>10}\n",
      count, s.images.list.size(), pairs.close, pairs.listed, s.rebuilds, s.prunings, s.steps, "part",
      "ns/particle", "flop/particle", "% of peak", "byte/particle", "% of peak");
  const auto counts = counts_of(s, pairs);
  double rest = m.whole;
  for (std::size_t k = 0; k < m.stage.size(); ++k) {
    print_row(stage_names[k], m.stage[k] / count, counts[k], peaks);
    rest -= m.stage[k];
  }
  const auto per_particle = [&](double seconds) { return 1e9 * seconds / count; };
  fmt::print("{:<20}{:>12.1f}\n{:<20}{:>12.1f}   {:.3g} particle-steps/s\n", "rest", per_particle(rest),
             "whole step", per_particle(m.whole), count / m.whole);
  fmt::print("{:<20}{:>12.1f}   {:.0f} % of it, data checks for the wave speed included\n", "in the VUMAT",
             per_particle(m.material), 100 * m.material / m.whole);
  const auto memory = memory_of(s);
  fmt::print("memory per particle: {:.0f} bytes, neighbour lists {:.0f} bytes more\n", memory.data / count,
             memory.lists / count);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: host_rate SCENE.toml [TIME [BATCHES]]\n", 2;
  omp_set_num_threads(1);
  const auto scene = drivers::read_scene(argv[1]);
  const double until = argc > 2 ? std::stod(argv[2]) : 0.01;
  with_geometry(scene.geometry, [&](auto geometry) {
    auto s = start_simulation<decltype(geometry)>(scene);
    while (s.time < until) step(s);
    print_measured(s, argc > 3 ? std::stoi(argv[3]) : 15);
  });
}
