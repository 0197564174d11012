// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/scene_file.hpp"
#include "drivers/files/material_file.hpp"
#include "drivers/files/toml_table.hpp"
#include "drivers/files/wall_file.hpp"
#include "host/files/output.hpp"
#include "host/files/result_read.hpp"
#include "vumat/parameters.hpp"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>

namespace drivers {
namespace {

/// Softens SIMSAND: waves are slower and steps longer; strength, dilatancy and critical state stay.
void scale_stiffness(const TomlTable& material, LoadedMaterial& loaded) {
  constexpr auto key = "stiffness_scale";
  if (!loaded.is_simsand) {
    if (material.has(key)) material.fail(key, "a material that is SIMSAND", "one with PROPS of its own");
    return;
  }
  constexpr int stiffness = 0;
  static_assert(simsand::parameters[stiffness].key == "K0");
  const double scale = material.number(key, {1e-3, 1}, 1.0), least = simsand::parameters[stiffness].lower;
  double& value = loaded.material.properties[stiffness];
  if (value * scale < least)
    material.fail(key, fmt::format("a number that leaves K0 at {} or more", least),
                  fmt::format("{} for K0 = {}", scale, value));
  value *= scale;
}

void read_material(const TomlTable& root, host::Scene& scene) {
  const auto table = root.table("material");
  auto loaded = read_material(table);
  scale_stiffness(table, loaded);
  scene.material = loaded.material;
  scene.state_names = loaded.state_names;
  scene.initial_state = loaded.initial_state;
  scene.failure_state = loaded.failure_state;
  scene.bulk_density = loaded.bulk_density;
  if (loaded.is_simsand) scene.friction_angle = scene.material.properties[simsand::parameter_index("phi")];
}

void read_initial_stress(const TomlTable& root, host::Scene& scene) {
  const auto table = root.table_or_empty("initial_stress");
  std::optional<double> at_rest; // Jaky 1944: K0 = 1 - sin(phi)
  if (scene.friction_angle > 0) at_rest = 1 - std::sin(scene.friction_angle * std::numbers::pi / 180);
  scene.earth_pressure_ratio = table.number("K0", {0, 10}, at_rest);
}

/// Where there is a list of walls a scene may do without floor and gate.
void read_floor_and_gate(const TomlTable& root, bool has_walls, host::Scene& scene) {
  scene.floor.present = !has_walls || root.has("floor");
  if (scene.floor.present) {
    const auto friction = root.table("floor").number_or_word("friction", {0, 10}, {"no-slip"});
    scene.floor.no_slip = std::holds_alternative<std::string>(friction);
    if (!scene.floor.no_slip) scene.floor.friction = std::get<double>(friction);
  }
  if (has_walls && !root.has("gate")) {
    scene.gate.motion = host::GateMotion::remove;
    return;
  }
  const auto gate = root.table("gate");
  const auto motion = gate.text("motion", {"lift", "remove", "fixed"});
  scene.gate.motion = motion == "lift"     ? host::GateMotion::lift
                      : motion == "remove" ? host::GateMotion::remove
                                           : host::GateMotion::fixed;
  if (scene.gate.motion == host::GateMotion::lift) scene.gate.speed = gate.number("speed", positive);
}

void read_geometry(const TomlTable& table, host::Scene& scene) {
  using host::GeometryKind, host::Sector;
  const auto geometry = table.text("geometry", {"axisymmetric", "plane_strain", "three_dimensional"});
  scene.geometry = geometry == "axisymmetric"   ? GeometryKind::axisymmetric
                   : geometry == "plane_strain" ? GeometryKind::plane_strain
                                                : GeometryKind::three_dimensional;
  if (scene.geometry != GeometryKind::three_dimensional) return;
  const auto sector = table.text("sector", {"full", "half", "quarter"});
  scene.sector = sector == "full" ? Sector::full : (sector == "half" ? Sector::half : Sector::quarter);
}

void read_numerics(const TomlTable& root, host::Scene& scene) {
  auto& numerics = scene.numerics;
  // Clusters of eight list many more neighbours in three dimensions than one particle has: the skin must be thin.
  if (scene.geometry == host::GeometryKind::three_dimensional) numerics.skin = 0.2;
  const auto table = root.table_or_empty("numerics");
  const auto kernel = table.text("kernel", {"wendland-c2", "wendland-c4"}, "wendland-c2");
  numerics.kernel = kernel == "wendland-c2" ? host::KernelKind::wendland_c2 : host::KernelKind::wendland_c4;
  numerics.smoothing_length = table.number("smoothing_length", {1.1, 3}, numerics.smoothing_length);
  numerics.viscosity = table.number("viscosity", {0, 10}, numerics.viscosity);
  numerics.flow_viscosity = table.number("flow_viscosity", {0, 1000}, numerics.flow_viscosity);
  numerics.stress_diffusion = table.number("stress_diffusion", {0, 100}, numerics.stress_diffusion);
  numerics.step_factor = table.number("step_factor", {1e-4, 1}, numerics.step_factor);
  numerics.wave_speed_tolerance =
      table.number("wave_speed_tolerance", {0, 0.2}, numerics.wave_speed_tolerance);
  numerics.skin = table.number("skin", {0.01, 3}, numerics.skin);
}

} // namespace

host::Scene read_scene(const std::string& path, const std::vector<std::string>& settings) {
  const bool stored = std::filesystem::path(path).extension() == ".h5";
  const auto root =
      stored ? parse_toml(host::stored_scene(path), path, ".", settings) : read_toml(path, settings);
  host::Scene scene;
  const auto general = root.table("scene");
  read_geometry(general, scene);
  scene.spacing = general.number("spacing", {1e-6, 1e3});
  scene.gravity = general.number("gravity", {1e-3, 1e3}, 9.81);
  const auto column = root.table("column");
  scene.column.radius = column.number("radius", {1e-6, 1e4});
  scene.column.height = column.number("height", {1e-6, 1e4});
  scene.gate.radius = scene.column.radius;
  if (root.has("wall")) read_placement(column, scene);
  read_material(root, scene);
  read_initial_stress(root, scene);
  read_floor_and_gate(root, root.has("wall"), scene);
  read_numerics(root, scene);
  const auto end = root.table("end");
  scene.end_time = end.number("time", positive);
  scene.walls = read_walls(root, scene);
  scene.rest_fraction = end.number("kinetic_energy_fraction", {0, 1}, 1e-6);
  const auto output = root.table("output");
  scene.output_folder = output.text("folder");
  if (scene.output_folder.empty()) output.fail("folder", "the name of a folder", "an empty text");
  scene.sample_interval = output.number("sample_interval", positive);
  scene.snapshot_interval = output.number("snapshot_interval", positive);
  scene.checkpoint_interval = output.number("checkpoint_interval", positive, scene.checkpoint_interval);
  scene.grain_diameter = output.number("grain_diameter", positive);
  if (!scene.walls.empty()) check_walls(root, scene);
  root.finish();
  scene.resolved = root.resolved();
  return scene;
}

} // namespace drivers
