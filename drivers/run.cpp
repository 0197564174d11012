// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run.hpp"
#include "drivers/laws.hpp"
#include "drivers/recorder.hpp"
#include "host/geometry.hpp"
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/spdlog.h>

namespace drivers {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A line every two seconds: simulated time, step size, rate, time left if the run goes to its latest end.
class Progress {
public:
  explicit Progress(bool quiet) : quiet(quiet) {}

  template <class Geometry> void report(const host::Simulation<Geometry>& s) {
    if (quiet || s.steps % 64 != 0 || seconds_since(last) < 2) return;
    last = Clock::now();
    const double elapsed = seconds_since(start);
    spdlog::info(
        "t = {:.4f} s of at most {:.3g} s   step {:.2e} s   {:.3g} particle-steps/s   at most {:.0f} s left",
        s.time, s.scene.end_time, s.dt, double(s.steps) * s.particles.count / elapsed,
        (s.scene.end_time - s.time) / s.time * elapsed);
  }
  double elapsed() const { return seconds_since(start); }

private:
  bool quiet;
  Clock::time_point start = Clock::now(), last = start;
};

template <class Geometry>
Summary summarise(const host::Simulation<Geometry>& s, const Recorder<Geometry>& recorder,
                  double wall_seconds) {
  const auto& p = s.particles;
  const double r0 = s.scene.column.radius, e0 = s.initial_potential_energy;
  const auto heights = host::outline(p, s.kernel, recorder.radii());
  const Sample& last = recorder.samples().back();
  double worst = 0, solid_volume = 0;
  for (const Sample& sample : recorder.samples()) worst = std::max(worst, std::abs(sample.imbalance));
  for (int i = 0; i < p.count; ++i) solid_volume += p.mass[i] / p.density[i];
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Summary summary{
      {{"final_height", "r0"}, host::outline_height(heights) / r0},
      {{"runout", "r0"}, host::front_radius(recorder.radii(), heights, s.scene.grain_diameter) / r0 - 1},
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
       host::outline_volume<Geometry>(recorder.radii(), heights) / solid_volume},
      {{"held_at_walls", "particle-steps"}, double(s.work.guarded)},
      {{"particles", "1"}, double(p.count)},
      {{"steps", "1"}, double(s.steps)},
      {{"list_rebuilds", "1"}, double(s.rebuilds)},
      {{"wall_clock", "s"}, wall_seconds},
      {{"rate", "particle-steps/s"}, double(s.steps) * p.count / wall_seconds},
      {{"threads", "1"}, double(omp_get_max_threads())},
  };
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

template <class Geometry> Summary run(const host::Scene& scene, const RunOptions& options) {
  auto simulation = host::start_simulation<Geometry>(scene);
  Recorder<Geometry> recorder(simulation);
  if (!options.quiet)
    spdlog::info("{} particles of {:.4g} mm, {}, {} threads", simulation.particles.count, 1e3 * scene.spacing,
                 Geometry::name, omp_get_max_threads());
  Progress progress(options.quiet);
  recorder.observe(simulation);
  try {
    while (simulation.time < scene.end_time && !recorder.at_rest()) {
      host::step(simulation);
      recorder.observe(simulation);
      progress.report(simulation);
    }
  } catch (...) {
    recorder.write_snapshot(simulation);
    throw;
  }
  recorder.write_snapshot(simulation);
  const Summary summary = summarise(simulation, recorder, progress.elapsed());
  recorder.finish(simulation, summary);
  print_table(scene, summary, recorder.file());
  return summary;
}

} // namespace

Summary run_scene(const host::Scene& scene, const RunOptions& options) {
  if (scene.geometry == host::GeometryKind::plane_strain) return run<host::PlaneStrain>(scene, options);
  return run<host::Axisymmetric>(scene, options);
}

} // namespace drivers
