// SPDX-License-Identifier: BSD-3-Clause
// What a step costs: `host_rate SCENE.toml [TIME [REPEATS]]` leads a scene of any geometry to TIME (s), then repeats
// each part of a step on copies of that state and prints the median of its processor time for each particle, its
// flops and bytes, and their share of what this kind of machine can do; last the whole step, and the memory of a
// particle. Processor time, so that other programs disturb little. One thread.
//
// Flops are counted in the source, for all entries of the lists, since an entry is computed for all eight particles;
// additions, multiplications, square roots and divisions one each. Those of the material are its own affair. Bytes
// are those of the arrays that a part reads and writes for a particle, and for pairs of the neighbours' records.
#include "drivers/files/scene_file.hpp"
#include "host/engine/material_calls.hpp"
#include "host/engine/simulation.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/benchmark/peaks.hpp"
#include <algorithm>
#include <chrono>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <iostream>
#include <omp.h>
#include <utility>

namespace {

using namespace host;

double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <class Geometry> using Stage = std::function<void(Simulation<Geometry>&)>;

/// Median processor time of `stage` on fresh copies of `state`, s.
template <class Geometry>
double median_time(const Simulation<Geometry>& state, int repeats, const Stage<Geometry>& stage) {
  std::vector<double> times;
  auto s = state;
  for (int k = 0; k < repeats; ++k) {
    s.particles = state.particles;
    s.records = state.records;
    const double start = processor_seconds();
    stage(s);
    times.push_back(processor_seconds() - start);
  }
  std::ranges::nth_element(times, times.begin() + repeats / 2);
  return times[repeats / 2];
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

template <class Geometry> struct Row {
  const char* name;
  double flops, bytes; ///< for each particle; flops 0: not counted
  Stage<Geometry> stage;
};

/// The parts of a step, one by one. The state must hold the arrays that pass between them.
template <class Geometry> std::vector<Row<Geometry>> rows(const Simulation<Geometry>& state) {
  using Run = Simulation<Geometry>;
  constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  constexpr double motion = sizeof(MotionRecord<D>), stress = sizeof(StressRecord<Geometry>), real = 8;
  const double listed = count_pairs(state).listed, states = double(state.particles.state.size());
  const double answer = S + states + 2; // what a material changes
  const double images = double(state.images.list.size()) / state.particles.count;
  const Increment increment{state.time + state.dt, state.time + state.dt, state.dt};
  return {
      {"motion records", 3, (2 * D + 2) * real + motion * (1 + 2 * images),
       [](Run& s) {
         show_motion(s.particles, s.records);
         reflect_motion(s.images, s.mirrors, s.records);
       }},
      {"wave speed", 0, (S + 2) * real,
       [](Run& s) { update_wave_speed(s.particles, s.scene.material, s.blocks, s.steps); }},
      {"gradient", gradient_flops<D> * listed, (2 * D + D * D) * real + (motion + 4) * listed / lanes,
       [](Run& s) { update_gradient(s.particles, s.kernel, s.lists, s.records); }},
      {"stress", 0, (2 * answer + D * D + 2 * D + 3) * real,
       [=](Run& s) { update_stress(s.particles, s.scene.material, increment, s.blocks); }},
      {"stress records", 4 * D * D, (S + D * D + 3) * real + stress * (1 + 2 * images),
       [](Run& s) {
         show_stress(s.particles, s.scene, s.kernel.h, s.records);
         reflect_stress(s.images, s.mirrors, s.records);
       }},
      {"forces", pair_flops<Geometry> * listed,
       (2 * S + 2 + 3 * D) * real + (motion + stress + 4) * listed / lanes,
       [](Run& s) { update_acceleration(s.particles, s.kernel, s.lists, s.records, s.scene); }},
      {"motion", 20 * D, (3 * D + 4 * D + 1) * real,
       [](Run& s) { integrate(s.particles, s.scene, s.mirrors, s.kernel.support, s.dt_before, s.dt); }},
  };
}

void print_row(const char* name, double seconds, double flops, double bytes, const tests::Peaks& peaks) {
  fmt::print("{:<16}{:>12.1f}", name, 1e9 * seconds);
  if (flops > 0)
    fmt::print("{:>14.0f}{:>10.0f}", flops, 100 * flops / seconds / peaks.flops);
  else
    fmt::print("{:>14}{:>10}", "-", "-");
  fmt::print("{:>14.0f}{:>10.0f}\n", bytes, 100 * bytes / seconds / peaks.bytes);
}

/// Processor time of `steps` whole steps, s for each.
template <class Geometry> double step_time(Simulation<Geometry>& s, int steps) {
  const double start = processor_seconds();
  for (int k = 0; k < steps; ++k) step(s);
  return (processor_seconds() - start) / steps;
}

/// Forwards to a subroutine and adds up its time: processes that interrupt it count, so medians are taken.
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

/// Share of whole steps that is spent inside of the material, median.
template <class Geometry> double material_share(Simulation<Geometry>& s, int repeats, int steps) {
  using Clock = Timed<vumat::Subroutine<double>>;
  auto& call = s.scene.material.library.call;
  Clock::subroutine = std::exchange(call, Clock::call);
  std::vector<double> shares;
  for (int k = 0; k < repeats; ++k) {
    Clock::seconds = 0;
    const double all = step_time(s, steps) * steps;
    shares.push_back(Clock::seconds / all);
  }
  call = Clock::subroutine;
  std::ranges::nth_element(shares, shares.begin() + repeats / 2);
  return shares[repeats / 2];
}

template <class Geometry> void measure(Simulation<Geometry>& s, int repeats) {
  const double count = s.particles.count;
  const auto pairs = count_pairs(s);
  const auto peaks = tests::measured_peaks();
  fmt::print("peaks of a core, measured: {:.0f} GFlop/s, {:.0f} GB/s\n", 1e-9 * peaks.flops,
             1e-9 * peaks.bytes);
  fmt::print(
      "{} particles, {} images; {:.1f} neighbours within the support, {:.1f} computed, {} rebuilds and "
      "{} prunings in {} steps\n{:<16}{:>12}{:>14}{:>10}{:>14}{:>10}\n",
      count, s.images.list.size(), pairs.close, pairs.listed, s.rebuilds, s.prunings, s.steps, "part",
      "ns/particle", "flop/particle", "% of peak", "byte/particle", "% of peak");
  const auto memory = memory_of(s);
  auto state = s;
  state.particles.each_of_stages([&](Array& a) { a.assign(state.particles.padded(), 0.0); });
  update_gradient(state.particles, state.kernel, state.lists, state.records);
  double all = 0, wave = 0, stress = 0;
  for (const auto& row : rows(state)) {
    const double seconds = median_time(state, repeats, row.stage) / count;
    if (row.name == std::string("wave speed")) wave = seconds;
    if (row.name == std::string("stress")) stress = seconds;
    all += seconds;
    print_row(row.name, seconds, row.flops, row.bytes, peaks);
  }
  const double rebuild =
      median_time<Geometry>(state, std::max(3, repeats / 4), [](auto& run) { update_lists(run); });
  const double pruning = median_time<Geometry>(state, repeats, [](auto& run) {
    prune(run.particles, run.records, 1.01 * run.kernel.support, run.outer_lists, run.lists);
  });
  const double lists =
      (rebuild * double(s.rebuilds) + pruning * double(s.prunings - s.rebuilds)) / (count * double(s.steps));
  fmt::print(
      "{:<16}{:>12.1f}\n{:<16}{:>12.1f}   {:.3g} particle-steps/s; wave speed and stress {:.0f} % of it\n",
      "lists", 1e9 * lists, "sum", 1e9 * (all + lists), 1 / (all + lists),
      100 * (wave + stress) / (all + lists));
  std::vector<double> times;
  const int steps = std::max(1, int(2e4 / count));
  for (int k = 0; k < repeats; ++k) times.push_back(step_time(s, steps));
  std::ranges::nth_element(times, times.begin() + repeats / 2);
  const double whole = times[repeats / 2] / count;
  const double share = material_share(s, repeats, steps);
  fmt::print("{:<16}{:>12.1f}   {:.3g} particle-steps/s\n", "whole step", 1e9 * whole, 1 / whole);
  fmt::print("{:<16}{:>12.1f}   {:.0f} % of it, data checks for the wave speed included\n", "in the VUMAT",
             1e9 * whole * share, 100 * share);
  fmt::print("memory per particle: {:.0f} bytes, neighbour lists {:.0f} bytes more\n", memory.data / count,
             memory.lists / count);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: host_rate SCENE.toml [TIME [REPEATS]]\n", 2;
  omp_set_num_threads(1);
  const auto scene = drivers::read_scene(argv[1]);
  const double until = argc > 2 ? std::stod(argv[2]) : 0.01;
  with_geometry(scene.geometry, [&](auto geometry) {
    auto s = start_simulation<decltype(geometry)>(scene);
    while (s.time < until) step(s);
    measure(s, argc > 3 ? std::stoi(argv[3]) : 15);
  });
}
