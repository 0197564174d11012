// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/parameter_sets.hpp"
#include "drivers/files/toml_table.hpp"
#include "host/files/hdf5_read.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;
using Settings = std::vector<std::string>;

/// Void ratio of the column of discrete elements when it was released, if there is one.
std::optional<double> released_void_ratio(const StudyColumn& column) {
  const auto path = fs::path(column.data) / "dem/results" /
                    fmt::format("column_{}_{}_{}.h5", column.shape(), column.packing(), column.aspect());
  if (!fs::exists(path)) return std::nullopt;
  try {
    return host::number_attribute<double>(host::open_to_read(path), "void_ratio");
  } catch (const H5::Exception& error) {
    throw std::runtime_error(
        fmt::format("{}: expected the attribute void_ratio: {}", path.string(), error.getDetailMsg()));
  }
}

Settings drucker_prager(const StudyColumn& column) {
  const double angle = read_toml(calibrated_material(column)).number("phi");
  const auto file = fs::absolute(fs::path(column.data) / "materials/drucker_prager_24.toml");
  const double at_rest = 1 - std::sin(angle * std::numbers::pi / 180);     // Jaky 1944
  return {"material.file=" + file.string(), "material.kinematics=jaumann", // isotropic: no need of F and U
          fmt::format("material.properties=[2e6, 0.2, {}, 0.0, 0.0]", angle),
          fmt::format("initial_stress.K0={}", at_rest)};
}

} // namespace

std::string StudyColumn::shape() const {
  auto shape = name.substr(0, 2);
  std::transform(shape.begin(), shape.end(), shape.begin(), ::toupper);
  return shape;
}

std::string StudyColumn::packing() const {
  return name.substr(3, name.rfind('_') - 3);
}

std::string StudyColumn::aspect() const {
  return name.substr(name.rfind("_a") + 2);
}

const std::vector<std::string>& parameter_sets() {
  static const std::vector<std::string> sets = {"table4", "dem", "literal", "dem_packing", "drucker_prager"};
  return sets;
}

bool is_sensitivity(const std::string& set) {
  return set != "table4" && set != "dem";
}

std::string calibrated_material(const StudyColumn& column) {
  const auto file = fs::absolute(fs::path(column.data) / "materials" / (column.shape() + "_dem.toml"));
  if (!fs::exists(file))
    throw std::runtime_error(
        fmt::format("{}: expected the material calibrated on discrete elements, found no "
                    "file; simsand calibrate writes it",
                    file.string()));
  return file.string();
}

std::optional<Settings> set_settings(const std::string& set, const StudyColumn& column) {
  if (set == "table4") return Settings{};
  // The paper heads its column of porosities "void ratio".
  const double printed = column.void_ratio / (1 + column.void_ratio);
  if (set == "literal") return Settings{fmt::format("material.void_ratio={:.4f}", printed)};
  if (set == "drucker_prager") return drucker_prager(column);
  Settings settings = {"material.file=" + calibrated_material(column)};
  if (set == "dem_packing") {
    const auto void_ratio = released_void_ratio(column);
    if (!void_ratio) return std::nullopt;
    settings.push_back(fmt::format("material.void_ratio={:.4f}", *void_ratio));
  }
  return settings;
}

} // namespace drivers
