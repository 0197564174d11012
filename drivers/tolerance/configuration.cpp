// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/configuration.hpp"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>

namespace drivers {
namespace {

const Configuration defaults;

Words material_settings(const host::Scene& scene, const std::string& data) {
  const double weight = scene.bulk_density * scene.gravity * scene.column.height;
  const double at_rest = 1 - std::sin(scene.friction_angle * std::numbers::pi / 180);
  const auto file = std::filesystem::absolute(data) / "materials/drucker_prager_24.toml";
  return {
      "material.file=" + file.string(),
      fmt::format("material.properties=[{:.6e}, 0.2, {:.6f}, 0.0, 0.0]", 2500 * weight, scene.friction_angle),
      fmt::format("initial_stress.K0={:.6f}", at_rest)};
}

Words geometry_settings(const std::string& geometry) {
  if (geometry == "axisymmetric" || geometry == "plane_strain") return {"scene.geometry=" + geometry};
  return {"scene.geometry=three_dimensional", "scene.sector=" + geometry};
}

} // namespace

Configuration at_resolution(Configuration configuration, double resolution) {
  configuration.resolution = resolution;
  return configuration;
}

double size_of(const host::Column& column) {
  return std::sqrt(column.radius * column.height);
}

Words settings_of(const Configuration& c, const host::Scene& scene, const std::string& data) {
  Words settings = geometry_settings(c.geometry);
  settings.push_back(fmt::format("scene.spacing={:.9g}", size_of(scene.column) / c.resolution));
  if (c.material == "drucker_prager")
    for (auto& setting : material_settings(scene, data)) settings.push_back(setting);
  if (c.precision == "single") settings.push_back("material.library=libsimsand_single_vumat.so");
  const auto set = [&](const char* key, double value, double usual) {
    if (value != usual) settings.push_back(fmt::format("{}={:.9g}", key, value));
  };
  set("material.stiffness_scale", c.stiffness_scale, defaults.stiffness_scale);
  set("numerics.step_factor", c.step_factor, defaults.step_factor);
  if (c.kernel != defaults.kernel) settings.push_back("numerics.kernel=" + c.kernel);
  set("numerics.smoothing_length", c.smoothing_length, defaults.smoothing_length);
  return settings;
}

std::string described(const Configuration& c) {
  const bool solid = c.geometry == "quarter" || c.geometry == "half" || c.geometry == "full";
  std::string text = solid ? "three dimensions, " + c.geometry : c.geometry;
  text += c.material == "simsand" ? ", SIMSAND" : ", " + c.material;
  text += fmt::format(", {} precision, stiffness scale {:g}", c.precision, c.stiffness_scale);
  if (c.step_factor != defaults.step_factor) text += fmt::format(", step factor {:g}", c.step_factor);
  if (c.kernel != defaults.kernel) text += ", kernel " + c.kernel;
  if (c.smoothing_length != defaults.smoothing_length)
    text += fmt::format(", smoothing length {:g} spacings", c.smoothing_length);
  return text;
}

std::string short_name(const Configuration& c) {
  std::string name = fmt::format("{}_n{:g}", c.geometry, c.resolution);
  if (c.material != defaults.material) name += "_" + c.material;
  if (c.precision != defaults.precision) name += "_" + c.precision;
  if (c.stiffness_scale != 1) name += fmt::format("_stiffness{:g}", c.stiffness_scale);
  if (c.step_factor != defaults.step_factor) name += fmt::format("_step{:g}", c.step_factor);
  if (c.kernel != defaults.kernel) name += "_" + c.kernel;
  if (c.smoothing_length != defaults.smoothing_length)
    name += fmt::format("_smoothing{:g}", c.smoothing_length);
  return name;
}

} // namespace drivers
