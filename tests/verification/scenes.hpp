// SPDX-License-Identifier: BSD-3-Clause
// Scenes for the tests of the host: the shipped materials, written as a user would write them.
#pragma once
#include "drivers/files/scene_file.hpp"
#include "drivers/run/run.hpp"
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace tests {

/// A column of radius 50 mm; the rest are the default scene's values.
struct ColumnCase {
  std::string geometry = "axisymmetric", material = "TS";
  double void_ratio = 0.4451, aspect = 1, spacing = 0.002;
  std::string gate = "motion = \"lift\"\nspeed = 1.6", friction = "0.5", numerics = "",
              extra = ""; ///< extra: keys of the material
  double end_time = 1.5, rest_fraction = 1e-6;
};

/// The folder of this test's results, empty at the start.
inline std::string fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::path(SIMSAND_BINARY_DIR) / "test_results" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

inline host::Scene column_scene(const ColumnCase& c, const std::string& name) {
  const auto folder = fresh_folder(name);
  const auto path = folder + "/scene.toml";
  std::ofstream(path) << fmt::format(
      "[scene]\ngeometry = \"{}\"\nspacing = {}\ngravity = 9.81\n[column]\nradius = 0.05\nheight = {}\n"
      "[material]\nfile = \"{}/data/materials/{}.toml\"\nvoid_ratio = {}\n{}\n[floor]\nfriction = "
      "{}\n[gate]\n{}\n"
      "[end]\ntime = {}\nkinetic_energy_fraction = {}\n[output]\nfolder = \"{}\"\nsample_interval = 0.005\n"
      "snapshot_interval = 0.5\ngrain_diameter = 0.00295\n[numerics]\n{}\n",
      c.geometry, c.spacing, 0.05 * c.aspect, SIMSAND_SOURCE_DIR, c.material, c.void_ratio, c.extra,
      c.friction, c.gate, c.end_time, c.rest_fraction, folder, c.numerics);
  return drivers::read_scene(path);
}

/// Value of a quantity of a run's summary.
inline double value_of(const drivers::Summary& summary, const std::string& name) {
  for (const auto& [quantity, value] : summary)
    if (quantity.name == name) return value;
  ADD_FAILURE() << "no " << name << " in the summary";
  return 0;
}

} // namespace tests
