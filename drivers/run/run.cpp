// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/run.hpp"
#include "drivers/run/checkpointer.hpp"
#include "drivers/run/forecast.hpp"
#include "drivers/run/interrupt.hpp"
#include "drivers/run/laws.hpp"
#include "drivers/run/recorder.hpp"
#include "host/engine/guard.hpp"
#include "host/engine/step.hpp"
#include "host/material/utilities.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

namespace drivers {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A line every two seconds: simulated time, step size, rate, time left until the run is expected to be at
/// rest (once that has passed: until its latest end).
class Progress {
public:
  template <class Geometry>
  Progress(bool quiet, const host::Simulation<Geometry>& s, const host::Spent& before)
      : quiet(quiet), before(before), first_time(s.time), first_step(s.steps) {}

  template <class Geometry> void report(const host::Simulation<Geometry>& s) {
    if (quiet || s.steps % 64 != 0 || seconds_since(last) < 2) return;
    last = Clock::now();
    const double seconds = seconds_since(start), expected = expected_end(s.scene);
    const bool late = s.time >= expected || expected == s.scene.end_time;
    spdlog::info("t = {:.4f} s of {} {:.3g} s   step {:.2e} s   {:.3g} particle-steps/s   {} {:.0f} s left",
                 s.time, late ? "at most" : "about", late ? s.scene.end_time : expected, s.dt,
                 double(s.steps - first_step) * s.particles.count / seconds, late ? "at most" : "about",
                 ((late ? s.scene.end_time : expected) - s.time) / (s.time - first_time) * seconds);
  }
  /// By all parts of the run.
  host::Spent spent() const {
    return {before.wall + seconds_since(start),
            before.processor + double(std::clock() - processor_start) / CLOCKS_PER_SEC};
  }

private:
  bool quiet;
  host::Spent before;
  double first_time;
  long first_step;
  std::clock_t processor_start = std::clock(); ///< of this process, all threads
  Clock::time_point start = Clock::now(), last = start;
};

template <class Geometry>
Summary summarise(const host::Simulation<Geometry>& s, const Recorder<Geometry>& recorder,
                  const host::Spent& spent) {
  const auto& p = s.particles;
  const double r0 = s.scene.column.radius, e0 = host::energy_scale(s);
  const auto profiles = host::surface_profiles(p, s.kernel, recorder.radii(), s.scene.sector);
  const auto heights = host::mean_profile(profiles);
  const auto front = host::front_of(profiles, recorder.radii(), s.scene.grain_diameter);
  const Sample& last = recorder.samples().back();
  double worst = 0, solid_volume = 0;
  for (const Sample& sample : recorder.samples()) worst = std::max(worst, std::abs(sample.imbalance));
  for (int i = 0; i < p.count; ++i) solid_volume += p.mass[i] / p.density[i];
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Summary summary{
      {{"final_height", "r0"}, host::outline_height(heights) / r0},
      {{"runout", "r0"}, front.mean / r0 - 1},
      {{"time_to_rest", "s"}, recorder.time_to_rest().value_or(nan)},
      {{"end_time", "s"}, s.time},
      {{"energy_imbalance", "initial potential energy"}, worst},
      {{"kinetic_energy", "initial potential energy"}, last.kinetic / e0},
      {{"work_stress", "initial potential energy"}, last.work.stress / e0},
      {{"work_viscosity", "initial potential energy"}, last.work.viscosity / e0},
      {{"work_wall", "initial potential energy"}, last.work.wall / e0},
      {{"work_friction", "initial potential energy"}, last.work.friction / e0},
      {{"material_stress_power", "initial potential energy"}, last.internal / e0},
      {{"material_dissipation", "initial potential energy"}, last.inelastic / e0},
      {{"outline_over_particle_volume", "1"},
       host::outline_volume<Geometry>(recorder.radii(), heights, s.scene.sector) / solid_volume},
      {{"held_at_walls", "particle-steps"}, double(s.work.guarded)},
      {{"particles", "1"}, double(p.count)},
      {{"steps", "1"}, double(s.steps)},
      {{"list_rebuilds", "1"}, double(s.rebuilds)},
      {{"wall_clock", "s"}, spent.wall},
      {{"time_processor", "s"}, spent.processor},
      {{"rate", "particle-steps/s"}, double(s.steps) * p.count / spent.wall},
      {{"threads", "1"}, double(omp_get_max_threads())},
      {{"memory_per_particle", "B"}, double(host::memory_of(s).data) / p.count},
  };
  if (Geometry::dimension == 3)
    summary.push_back({{"runout_scatter_over_azimuth", "r0"}, front.scatter / r0});
  for (std::size_t v = 0; v < s.scene.state_names.size(); ++v)
    if (s.scene.state_names[v] == "void_ratio") {
      constexpr double carries_stress = 20; // Pa
      const auto spread =
          host::spread_of(p, std::span<const double>(p.state[v]).first(p.count), carries_stress);
      summary.push_back({{"void_ratio_least", "1"}, spread.least});
      summary.push_back({{"void_ratio_mean", "1"}, spread.mean});
      summary.push_back({{"void_ratio_most", "1"}, spread.most});
    }
  for (std::size_t k = 0; k < host::stage_names.size(); ++k)
    summary.push_back({{fmt::format("time_{}", host::stage_names[k]), "s"}, s.stage_seconds[k]});
  return summary;
}

void print_table(const host::Scene& scene, const Summary& summary, const std::string& file) {
  const auto value = [&](const std::string& name) {
    for (const auto& [quantity, number] : summary)
      if (quantity.name == name) return number;
    return std::numeric_limits<double>::quiet_NaN();
  };
  const auto known = [](double v) {
    return std::isfinite(v) ? fmt::format("{:10.3f}", v) : fmt::format("{:>10}", "-");
  };
  fmt::print("\n{:<32}{:>10}{:>14}\n", "", "h_f/r0", "(r_f-r0)/r0");
  fmt::print("{:<32}{}{:>4}{}\n", "this run", known(value("final_height")), "", known(value("runout")));
  const double aspect = scene.column.height / scene.column.radius;
  for (const auto& law : column_laws(scene.geometry, aspect, scene.friction_angle))
    fmt::print("{:<32}{}{:>4}{}\n", law.source, known(law.height), "", known(law.runout));
  fmt::print("\nrest after 3 sqrt(h0/g) by Lube et al. 2004: {:.3f} s\n",
             3 * std::sqrt(scene.column.height / scene.gravity));
  fmt::print("material's stress power less the work of its pairs: {:.4f} of the initial potential energy\n\n",
             value("material_stress_power") + value("work_stress"));
  for (const auto& [quantity, number] : summary)
    fmt::print("{:<32}{:>14}  {}\n", quantity.name,
               std::isfinite(number) ? fmt::format("{:.6g}", number) : "-",
               quantity.unit == "1" ? "" : quantity.unit);
  fmt::print("\nresults: {}\n", file);
}

/// Throws if kinetic and potential energy of the latest sample exceed what gravity and walls have given, or if the
/// energy balance is open.
template <class Geometry>
void check_latest(const host::Simulation<Geometry>& s, const Recorder<Geometry>& recorder) {
  const Sample& last = recorder.samples().back();
  if (last.time != s.time) return;
  const double given = host::given_by_walls(s), scale = host::energy_scale(s) + std::max(given, 0.0);
  if (scale <= 0) return;
  const double made = last.kinetic + last.potential - s.initial_potential_energy - given;
  host::check_energy(s.particles, s.time, made / scale, last.imbalance * host::energy_scale(s) / scale);
  host::check_work(s);
}

/// Warns if the stress of pairs did spurious positive work, which the viscosity dissipated, above `suspect_pair_gain`.
template <class Geometry>
void warn_of_pairs(const host::Simulation<Geometry>& s, const Recorder<Geometry>& recorder) {
  const auto work = [](const Sample& sample) { return host::pair_work(sample.work); };
  const Sample& worst = std::ranges::max(recorder.samples(), {}, work);
  const double share = work(worst) / host::energy_scale(s);
  if (!host::walls_rest(s.scene) || share <= host::suspect_pair_gain) return;
  spdlog::warn(
      "{}: until {:.4g} s the stress of pairs and walls had given the sand {:.3g} of the initial potential "
      "energy "
      "(beyond {} it is suspect), which the artificial viscosity took; compare with a run at another "
      "scene.spacing or numerics.step_factor",
      s.scene.output_folder, worst.time, share, host::suspect_pair_gain);
}

/// The loop of steps, until rest, the latest end or a request to stop.
template <class Geometry>
void advance(host::Simulation<Geometry>& simulation, Recorder<Geometry>& recorder, Progress& progress) {
  Checkpointer<Geometry> checkpointer(simulation.scene);
  recorder.observe(simulation);
  while (simulation.time < simulation.scene.end_time && !recorder.at_rest()) {
    if (const int signal = stop_requested()) {
      checkpointer.write(simulation, recorder, progress.spent());
      throw Interrupted(fmt::format("stopped by {} at {:.6g} s; to go on: simsand run --resume {}",
                                    strsignal(signal), simulation.time, simulation.scene.output_folder),
                        signal);
    }
    host::step(simulation);
    recorder.observe(simulation);
    check_latest(simulation, recorder);
    if (checkpointer.due()) checkpointer.write(simulation, recorder, progress.spent());
    progress.report(simulation);
  }
}

/// Writes the last state of a run that fails. An error here is dropped: the failure itself is reported.
template <class Geometry>
void keep_last_state(const host::Simulation<Geometry>& simulation, Recorder<Geometry>& recorder) {
  try {
    recorder.write_snapshot(simulation);
  } catch (const std::exception&) {}
}

template <class Geometry>
Summary finish(host::Simulation<Geometry>& simulation, Recorder<Geometry>& recorder, Progress& progress) {
  recorder.write_snapshot(simulation);
  const Summary summary = summarise(simulation, recorder, progress.spent());
  recorder.finish(simulation, summary);
  remove_checkpoints(simulation.scene.output_folder);
  warn_of_pairs(simulation, recorder);
  print_table(simulation.scene, summary, recorder.file());
  return summary;
}

template <class Geometry>
Summary run_on(host::Simulation<Geometry>& simulation, Recorder<Geometry>& recorder, Progress progress,
               bool quiet) {
  if (!quiet)
    spdlog::info("{} particles of {:.4g} mm, {}, {} threads", simulation.particles.count,
                 1e3 * simulation.scene.spacing, Geometry::name, omp_get_max_threads());
  try {
    advance(simulation, recorder, progress);
  } catch (const Interrupted&) {
    throw;
  } catch (...) {
    keep_last_state(simulation, recorder);
    throw;
  }
  return finish(simulation, recorder, progress);
}

template <class Geometry> Summary run(const host::Scene& scene, const RunOptions& options) {
  auto simulation = host::start_simulation<Geometry>(scene);
  if (options.checkpoint.empty()) {
    Recorder<Geometry> recorder(simulation);
    if (remove_checkpoints(scene.output_folder) && !options.quiet)
      spdlog::warn("{} held an unfinished run: it is replaced", scene.output_folder);
    return run_on(simulation, recorder, Progress(options.quiet, simulation, {}), options.quiet);
  }
  const auto done = host::read_run_progress(options.checkpoint);
  Recorder<Geometry> recorder(simulation, done); // while the particles are where they began
  for (const auto& part : recorder.left_out())
    spdlog::warn("{}: missing or not readable; the result goes on without this snapshot", part.string());
  host::read_checkpoint(options.checkpoint, simulation);
  remove_newer_checkpoint(options.checkpoint);
  if (!options.quiet) spdlog::info("going on from {:.6g} s", simulation.time);
  return run_on(simulation, recorder, Progress(options.quiet, simulation, done.spent), options.quiet);
}

} // namespace

Summary run_scene(const host::Scene& scene, const RunOptions& options) {
  const auto folder = std::filesystem::path(scene.output_folder).lexically_normal();
  auto named = scene;
  named.material.job = {(folder.has_filename() ? folder : folder.parent_path()).filename().string(),
                        scene.output_folder};
  return host::with_geometry(scene.geometry,
                             [&](auto geometry) { return run<decltype(geometry)>(named, options); });
}

} // namespace drivers
