// SPDX-License-Identifier: BSD-3-Clause
// Coarse columns, their decks, and what a checker should expect of them.
#pragma once
#include "drivers/abaqus/deck.hpp"
#include "drivers/files/scene_file.hpp"
#include "tests/abaqus/deck_check.hpp"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace abaqus {

namespace fs = std::filesystem;

struct Case {
  std::string geometry = "axisymmetric", motion = "lift", friction = "0.5";
  double speed = 1.6, spacing = 0.01, radius = 0.05, height = 0.05;
};

/// A fresh folder beside the test program.
inline fs::path folder(const std::string& name) {
  const auto path = fs::path(SIMSAND_BINARY_DIR) / "abaqus_test_results" / name;
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

inline std::string scene_text(const Case& c, const std::string& material) {
  const auto gate = fmt::format("motion = \"{}\"\n{}", c.motion,
                                c.motion == "lift" ? fmt::format("speed = {}\n", c.speed) : "");
  return fmt::format(
      "[scene]\ngeometry = \"{}\"\nspacing = {}\n[column]\nradius = {}\nheight = {}\n[material]\n{}"
      "[floor]\nfriction = {}\n[gate]\n{}[end]\ntime = 1.5\n[output]\nfolder = \"x\"\n"
      "sample_interval = 0.005\nsnapshot_interval = 0.05\ngrain_diameter = 0.00295\n",
      c.geometry, c.spacing, c.radius, c.height, material, c.friction, gate);
}

inline fs::path scene_file(const Case& c, const std::string& name) {
  const auto path = folder(name) / "scene.toml";
  std::ofstream(path) << scene_text(
      c, fmt::format("file = \"{}/data/materials/TS.toml\"\nvoid_ratio = 0.4451\n", SIMSAND_SOURCE_DIR));
  return path;
}

/// From the case's own numbers: grains of 2500 kg/m3, friction angle 24 degrees, void ratio 0.4451.
inline deck::Expected expected(const Case& c, const host::Scene& scene) {
  deck::Expected e;
  e.radius = c.radius;
  e.height = c.height;
  e.slab = c.geometry == "plane_strain";
  e.density = 2500 / 1.4451;
  e.gravity = 9.81;
  e.pressure_ratio = 1 - std::sin(24 * std::numbers::pi / 180);
  e.friction = c.friction == "\"no-slip\"" ? -1 : std::stod(c.friction);
  e.end_time = 1.5;
  e.lift_speed = c.motion == "lift" ? c.speed : 0;
  e.wall = c.motion != "remove";
  e.constants = scene.material.properties;
  e.state_variables = scene.state_names.size();
  e.first_state = 0.4451;
  return e;
}

struct Written {
  std::string text;
  deck::Expected expected;
};

inline Written written(const Case& c, const std::string& name) {
  const auto scene = drivers::read_scene(scene_file(c, name).string());
  return {drivers::abaqus_deck(scene, drivers::make_abaqus_model(scene, scene.spacing)), expected(c, scene)};
}

} // namespace abaqus
