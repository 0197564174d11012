// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/tolerance_scene.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/files/toml_table.hpp"
#include "host/files/result_read.hpp"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

namespace drivers {
namespace {

constexpr double smallest_grain = 2.95e-3 / 70.71e-3; // of the chart's columns, over sqrt(r0 h0)
const Words chosen_keys = {
    "scene.geometry",   "scene.sector",  "scene.spacing",        "material.stiffness_scale",
    "material.library", "material.name", "numerics.step_factor", "numerics.smoothing_length",
    "numerics.kernel"};

void refuse_chosen_settings(const Words& settings) {
  for (const auto& setting : settings) {
    const auto key = setting.substr(0, setting.find('='));
    if (std::find(chosen_keys.begin(), chosen_keys.end(), key) != chosen_keys.end())
      throw std::runtime_error(
          fmt::format("--set {}: expected no such key beside --tolerance, which chooses it or rests "
                      "on its default",
                      setting));
  }
}

TomlTable document(const std::string& file, const Words& settings) {
  const bool stored = std::filesystem::path(file).extension() == ".h5";
  return stored ? parse_toml(host::stored_scene(file), file, ".", settings) : read_toml(file, settings);
}

/// The defaults of a geometry.
host::Numerics usual_numerics(host::GeometryKind geometry) {
  host::Numerics numerics;
  if (geometry == host::GeometryKind::three_dimensional) {
    numerics.skin = 0.2;
    numerics.wave_speed_tolerance = 0.02;
  }
  return numerics;
}

void refuse_other_numerics(const TomlTable& root, const host::Scene& scene) {
  const auto table = root.table_or_empty("numerics");
  const auto& n = scene.numerics;
  const auto usual = usual_numerics(scene.geometry);
  const auto check = [&](const char* key, double value, double expected) {
    if (value != expected)
      table.fail(
          key, fmt::format("the default {:g} beside --tolerance, for which the chart's data hold", expected),
          fmt::format("{:g}", value));
  };
  if (n.kernel != usual.kernel)
    table.fail("kernel", "the default beside --tolerance, for which the chart's data hold",
               table.text("kernel"));
  check("smoothing_length", n.smoothing_length, usual.smoothing_length);
  check("viscosity", n.viscosity, usual.viscosity);
  check("flow_viscosity", n.flow_viscosity, usual.flow_viscosity);
  check("stress_diffusion", n.stress_diffusion, usual.stress_diffusion);
  check("step_factor", n.step_factor, usual.step_factor);
  check("wave_speed_tolerance", n.wave_speed_tolerance, usual.wave_speed_tolerance);
}

void refuse_other_material(const TomlTable& root, const host::Scene& scene) {
  const auto table = root.table("material");
  if (scene.friction_angle <= 0)
    table.fail("properties", "SIMSAND beside --tolerance, whose errors are charted", "another material");
  if (table.has("library"))
    table.fail("library", "no such key beside --tolerance, which chooses the library by its precision",
               "one");
  constexpr auto scale = "stiffness_scale";
  if (table.has(scale) && table.number(scale) != 1)
    table.fail(scale, "no such key beside --tolerance, which chooses it",
               fmt::format("{:g}", table.number(scale)));
}

} // namespace

host::Scene read_scene_to_choose(const std::string& file, const Words& settings) {
  refuse_chosen_settings(settings);
  auto scene = read_scene(file, settings);
  if (!scene.walls.empty())
    throw std::runtime_error(
        fmt::format("{}: key 'wall': expected [floor] and [gate] beside --tolerance, whose chart has "
                    "columns, found walls of a list",
                    file));
  const auto root = document(file, settings);
  refuse_other_material(root, scene);
  refuse_other_numerics(root, scene);
  return scene;
}

Words beyond_the_chart(const host::Scene& scene) {
  Words remarks;
  const double aspect = scene.column.height / scene.column.radius;
  if (aspect < 0.5 || aspect > 2)
    remarks.push_back(fmt::format("aspect ratio {:.3g}, the chart's columns have 0.5 to 2", aspect));
  if (scene.floor.no_slip || scene.floor.friction != 0.5)
    remarks.push_back("the floor, the chart's have a friction of 0.5");
  if (scene.gate.motion != host::GateMotion::lift) remarks.push_back("the gate, the chart's are lifted");
  return remarks;
}

double scene_resolution(const host::Scene& scene, double resolution) {
  const double grain = scene.grain_diameter / size_of(scene.column);
  return resolution * std::max(1.0, smallest_grain / grain);
}

std::string scene_without_choice(const host::Scene& scene, const Configuration& configuration) {
  std::stringstream lines(scene.resolved);
  std::string text, table;
  const bool simple = configuration.material != "simsand";
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) table = line;
    const bool numerics = table == "[numerics]", sector = table == "[scene]" && line.starts_with("sector ");
    const bool sand = table == "[material]" && !line.starts_with("[") && !line.starts_with("void_ratio ") &&
                      !line.starts_with("grain_density ");
    const bool at_rest = simple && table == "[initial_stress]";
    if (!numerics && !sector && !at_rest && !(simple && sand)) text += line + "\n";
  }
  return text;
}

} // namespace drivers
