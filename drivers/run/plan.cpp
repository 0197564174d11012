// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/plan.hpp"
#include "drivers/run/forecast.hpp"
#include "drivers/run/resume.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>

namespace drivers {
namespace {

// Both from the runs of tests/benchmark/plan.py, which scatter about them by 0.9 to 1.2 and 0.8 to 1.4.

/// Mean step of a collapse over the first one: the column stiffens where it is squeezed and softens where it
/// spreads, a tall one more than a low one.
double mean_step(double aspect) {
  return 0.88 * std::pow(aspect, 0.08);
}

/// Mean cost of a step over that of the first ones: flowing sand takes more of the material, and results are written.
constexpr double flowing = 1.25;

/// CPU seconds of this thread, which has its share in every stage: what the clock on the wall would show if the
/// cores were free.
double busy_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Shortest of several bursts, s per step.
template <class Geometry> double fastest_step(host::Simulation<Geometry>& s, double burst) {
  constexpr int parts = 6, at_least = 4;
  double fastest = INFINITY;
  host::step(s); // lists and records have their size after it
  for (int part = 0; part < parts; ++part) {
    const double start = busy_seconds();
    int steps = 0;
    for (; steps < at_least || busy_seconds() - start < burst / parts; ++steps) host::step(s);
    fastest = std::min(fastest, (busy_seconds() - start) / steps);
  }
  return fastest;
}

double memory_in_use() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

template <class Geometry> Plan plan(const host::Scene& scene, double burst) {
  auto s = host::start_simulation<Geometry>(scene);
  Plan plan;
  plan.particles = s.particles.count;
  plan.end = expected_end(scene);
  plan.latest_end = scene.end_time;
  const bool flows = scene.gate.motion != host::GateMotion::fixed;
  plan.seconds_per_step = (flows ? flowing : 1) * fastest_step(s, burst);
  plan.step = (flows ? mean_step(scene.column.height / scene.column.radius) : 1) * s.first_dt;
  plan.steps = plan.end / plan.step;
  plan.checkpoint = double(host::checkpoint_image(header_of(scene), s, {}).size());
  plan.memory = memory_in_use(); // the largest moment of a run is that of a checkpoint
  constexpr double compressed = 0.85, names = 30e3, column = 8e3; // of the numbers of a snapshot; bytes
  const double series =
      column * (13 + double(s.walls.size()) * (2 * Geometry::dimension + 3)); // of the time series
  const double numbers =
      2 * Geometry::dimension + Geometry::stress_components + 1 + double(s.particles.state.size());
  const double snapshots = std::floor(plan.end / scene.snapshot_interval) + 2;
  plan.disk = series + snapshots * (names + compressed * 8 * numbers * plan.particles);
  return plan;
}

std::string shown_time(double seconds) {
  if (seconds < 120) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

} // namespace

Plan plan_run(const host::Scene& scene, double burst) {
  return host::with_geometry(scene.geometry,
                             [&](auto geometry) { return plan<decltype(geometry)>(scene, burst); });
}

std::string described(const Plan& p, const host::Scene& scene) {
  const bool to_rest = p.end < p.latest_end;
  std::string text;
  const auto line = [&](const std::string& name, const std::string& value) {
    text += fmt::format("{:<12}{}\n", name, value);
  };
  line("particles", fmt::format("{} of {:.4g} mm", p.particles, 1e3 * scene.spacing));
  line("simulated", to_rest ? fmt::format("{:.2g} s until rest, at most {:.4g} s", p.end, p.latest_end)
                            : fmt::format("{:.4g} s", p.end));
  line("steps", fmt::format("{:.2g} of {:.2g} s", p.steps, p.step));
  line("time",
       fmt::format("{}{} on {} threads of free cores, {:.3g} particle-steps/s", shown_time(p.seconds()),
                   to_rest ? fmt::format(", at most {},", shown_time(p.most_seconds())) : "",
                   omp_get_max_threads(), p.particles / p.seconds_per_step));
  line("memory", fmt::format("{:.0f} MB", p.memory / 1e6));
  line("disk", fmt::format("{:.1f} MB, while it runs {:.1f} MB", p.disk / 1e6,
                           (2 * p.disk + 3 * p.checkpoint) / 1e6));
  return text;
}

} // namespace drivers
