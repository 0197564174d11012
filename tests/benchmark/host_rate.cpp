// SPDX-License-Identifier: BSD-3-Clause
// What each stage of a step costs: `host_rate SCENE.toml [TIME [REPEATS]]` leads a three-dimensional scene to TIME
// (s), then repeats each stage on a copy of that state and prints the median of its processor time for each
// particle, flops, their rate, and the memory of a particle. Processor time, so that other programs disturb
// little. One thread.
#include "drivers/scene_file.hpp"
#include "host/geometry.hpp"
#include "host/momentum_solid.hpp"
#include "host/simulation.hpp"
#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <iostream>
#include <omp.h>

namespace {

using namespace host;
using Run = Simulation<ThreeDimensional>;

double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Median processor time of `stage` on fresh copies of `state`, s.
double median_time(const Run& state, int repeats, const std::function<void(Run&)>& stage) {
  std::vector<double> times;
  Run s = state;
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
Pairs count_pairs(const Run& s) {
  Pairs pairs;
  const auto& p = s.particles;
  for (int c = 0; c < p.clusters(); ++c) {
    pairs.listed += double(lanes) * s.lists.total[c] / p.count;
    for (int i = c * lanes; i < std::min((c + 1) * lanes, p.count); ++i)
      for (int k = 0; k < s.lists.total[c]; ++k) {
        const auto& x = s.records.motion[s.lists.begin(c)[k]].position;
        double square = 0;
        for (int a = 0; a < 3; ++a) square += std::pow(x[a] - p.position[a][i], 2);
        pairs.close += (square < s.kernel.support * s.kernel.support) / double(p.count);
      }
  }
  return pairs;
}

struct Row {
  const char* name;
  double flops_per_entry; ///< counted in the source; square root and division as one each
  double bytes_per_entry; ///< of the neighbour's record, read once for eight particles
  std::function<void(Run&)> stage;
};

void measure(const Run& state, int repeats) {
  const auto pairs = count_pairs(state);
  const int count = state.particles.count;
  fmt::print("{} particles, {} images; {:.1f} neighbours within the support, {:.1f} computed, {} rebuilds in "
             "{} steps\n",
             count, state.images.list.size(), pairs.close, pairs.listed, state.rebuilds, state.steps);
  const Increment increment{state.time + state.dt, state.time + state.dt, state.dt};
  const Row rows[] = {
      {"motion records", 0, 0,
       [](Run& s) {
         show_motion(s.particles, s.records);
         reflect_motion(s.images, s.mirrors, s.records);
       }},
      {"wave speed", 0, 0,
       [](Run& s) { update_wave_speed(s.particles, s.scene.material, s.blocks, s.steps); }},
      {"gradient", gradient_flops<3>, sizeof(MotionRecord<3>),
       [](Run& s) { update_gradient(s.particles, s.kernel, s.lists, s.records); }},
      {"stress (VUMAT)", 0, 0,
       [&](Run& s) { update_stress(s.particles, s.scene.material, increment, s.blocks); }},
      {"stress records", 0, 0,
       [](Run& s) {
         show_stress(s.particles, s.scene, s.kernel.h, s.records);
         reflect_stress(s.images, s.mirrors, s.records);
       }},
      {"momentum", solid_pair_flops, sizeof(StressRecord<ThreeDimensional>),
       [](Run& s) { update_acceleration(s.particles, s.kernel, s.lists, s.records, s.scene); }},
      {"integrate", 0, 0,
       [](Run& s) { integrate(s.particles, s.scene, s.mirrors, s.kernel.support, s.dt_before, s.dt); }},
  };
  double all = 0;
  fmt::print("{:<16}{:>14}{:>16}{:>16}{:>12}\n", "stage", "ns/particle", "flop/particle", "byte/particle",
             "GFlop/s");
  const auto line = [&](const char* name, double seconds, double flops, double bytes) {
    all += seconds;
    fmt::print("{:<16}{:>14.1f}", name, 1e9 * seconds / count);
    if (flops > 0)
      fmt::print("{:>16.0f}{:>16.0f}{:>12.1f}\n", flops, bytes, 1e-9 * flops * count / seconds);
    else
      fmt::print("\n");
  };
  for (const auto& [name, flops, bytes, stage] : rows)
    line(name, median_time(state, repeats, stage), flops * pairs.listed, bytes * pairs.listed / lanes);
  const double rebuild = median_time(state, std::max(3, repeats / 4), [](Run& s) { update_lists(s); });
  line("lists", rebuild * double(state.rebuilds) / double(state.steps), 0, 0);
  fmt::print("{:<16}{:>14.1f}   {:.3g} particle-steps/s\n", "whole step", 1e9 * all / count, count / all);
  const auto memory = memory_of(state);
  fmt::print("memory per particle: {:.0f} bytes, neighbour lists {:.0f} bytes more\n",
             double(memory.data) / count, double(memory.lists) / count);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::cerr << "usage: host_rate SCENE.toml [TIME [REPEATS]]\n", 2;
  omp_set_num_threads(1);
  auto s = start_simulation<ThreeDimensional>(drivers::read_scene(argv[1]));
  const double until = argc > 2 ? std::stod(argv[2]) : 0.01;
  while (s.time < until) step(s);
  measure(s, argc > 3 ? std::stoi(argv[3]) : 15);
}
