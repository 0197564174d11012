// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/info.hpp"
#include "drivers/files/toml_table.hpp"
#include "drivers/run/resume.hpp"
#include "host/files/result_read.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <toml++/toml.h>

namespace drivers {
namespace {

using host::StoredRun;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double last(const StoredRun& run, const std::string& name) {
  for (const auto& [column, values] : run.series)
    if (column.name == name && !values.empty()) return values.back();
  return nan;
}

double summary(const StoredRun& run, const std::string& name) {
  for (const auto& [quantity, value] : run.summary)
    if (quantity.name == name) return value;
  return nan;
}

/// Simulated seconds from which the run would go on; NaN without a checkpoint beside the result.
double checkpoint_time(const std::string& file) {
  const auto folder = std::filesystem::path(file).parent_path();
  for (const auto& path : {checkpoint_path(folder), previous_checkpoint_path(folder)}) try {
      return host::verified_checkpoint(path).time;
    } catch (const std::runtime_error&) {}
  return nan;
}

std::string state_of(const StoredRun& run, const std::string& file) {
  if (run.complete) return "complete";
  if (run.checkpoint) return "checkpoint of a run that is not complete";
  const double from = checkpoint_time(file);
  return std::isnan(from) ? "not complete, without a checkpoint"
                          : fmt::format("not complete; a checkpoint of {:.6g} s is beside it", from);
}

/// What the page and the object show of the scene.
struct Scene {
  toml::table table;

  explicit Scene(const std::string& text) : table(toml::parse(std::string_view(text))) {}
  double number(const char* path) const { return table.at_path(path).value<double>().value_or(nan); }
  std::string text(const char* path, const char* fallback) const {
    return table.at_path(path).value<std::string>().value_or(fallback);
  }
};

/// Mean forces on the walls in the last sample interval.
std::string wall_lines(const StoredRun& run) {
  constexpr std::string_view begin = "wall_", end = "_normal_force";
  std::string text;
  for (const auto& [column, values] : run.series) {
    if (!column.name.starts_with(begin) || !column.name.ends_with(end) || values.empty()) continue;
    const auto name = column.name.substr(begin.size(), column.name.size() - begin.size() - end.size());
    std::string components;
    for (const char axis : {'r', 'x', 'y', 'z'})
      if (const double force = last(run, fmt::format("wall_{}_force_{}", name, axis)); !std::isnan(force))
        components += fmt::format(", {} {:.6g}", axis, force);
    text += fmt::format("{:<18}normal {:.6g}{} N, work {:.6g} J\n", "wall " + name, values.back(), components,
                        last(run, fmt::format("wall_{}_work", name)));
  }
  return text;
}

std::string page(const StoredRun& run, const std::string& file) {
  const Scene scene(run.scene);
  std::string text;
  const auto line = [&](const std::string& name, const std::string& value) {
    text += fmt::format("{:<18}{}\n", name, value);
  };
  const auto number = [&](const std::string& name, double value, const std::string& unit) {
    if (!std::isnan(value)) line(name, fmt::format("{:.6g}{}", value, unit));
  };
  line("file", file);
  line("state", state_of(run, file));
  line("written by", fmt::format("simsand {} ({})", run.version, run.compiler));
  line("scene", fmt::format("{}, column {:.4g} m wide, {:.4g} m high, {}, spacing {:.4g} m", run.geometry,
                            scene.number("column.radius"), scene.number("column.height"),
                            scene.text("material.name", "a material"), scene.number("scene.spacing")));
  line("particles", fmt::format("{:.0f}", run.particles));
  line("time", fmt::format("{:.6g} s of at most {:.6g} s", run.time, scene.number("end.time")));
  if (run.steps >= 0) line("steps", fmt::format("{:.0f}", run.steps));
  line("snapshots", fmt::format("{}", run.snapshots));
  number("height", last(run, "height"), " m");
  number("front", last(run, "front_radius"), " m");
  number("kinetic energy", last(run, "kinetic_energy"), " J");
  number("potential energy", last(run, "potential_energy"), " J");
  number("energy imbalance", last(run, "energy_imbalance"), " of the initial potential energy");
  text += wall_lines(run);
  number("final height", summary(run, "final_height"), " r0");
  number("runout", summary(run, "runout"), " r0");
  number("time to rest", summary(run, "time_to_rest"), " s");
  number("wall clock", summary(run, "wall_clock"), " s");
  return text;
}

std::string json_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (std::uint8_t(c) < 0x20)
      out += fmt::format("\\u{:04x}", int(c));
    else
      out += c;
  }
  return out + '"';
}

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

template <class Range, class F> std::string joined(const Range& range, F&& shown) {
  std::string text;
  for (const auto& element : range) text += (text.empty() ? "" : ", ") + shown(element);
  return text;
}

std::string object(const StoredRun& run, const std::string& file) {
  const auto entry = [](const auto& named) {
    return json_text(named.first.name) + ": " + json_number(named.second);
  };
  const auto last_of = [](const auto& column) {
    return json_text(column.first.name) + ": " +
           json_number(column.second.empty() ? nan : column.second.back());
  };
  return fmt::format(
      "{{\n  \"file\": {},\n  \"kind\": \"{}\",\n  \"complete\": {},\n  \"checkpoint_time\": {},\n"
      "  \"version\": {},\n  \"compiler\": {},\n  \"geometry\": {},\n  \"particles\": {:.0f},\n"
      "  \"time\": {},\n  \"steps\": {},\n  \"snapshots\": {},\n  \"snapshot_times\": [{}],\n"
      "  \"last_sample\": {{{}}},\n  \"summary\": {{{}}},\n  \"scene\": {}\n}}\n",
      json_text(file), run.checkpoint ? "checkpoint" : "result", run.complete,
      json_number(run.checkpoint ? run.time
                  : run.complete ? nan
                                 : checkpoint_time(file)),
      json_text(run.version), json_text(run.compiler), json_text(run.geometry), run.particles,
      json_number(run.time), json_number(run.steps < 0 ? nan : run.steps), run.snapshots,
      joined(run.snapshot_times, json_number), joined(run.series, last_of), joined(run.summary, entry),
      json_text(run.scene));
}

} // namespace

std::string describe_file(const std::string& file, bool json) {
  const auto run = host::read_stored_run(file);
  return json ? object(run, file) : page(run, file);
}

} // namespace drivers
