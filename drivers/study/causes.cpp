// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/causes.hpp"
#include "drivers/study/columns.hpp"
#include "drivers/study/parameter_sets.hpp"
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace drivers {
namespace {

struct Change {
  std::string name; ///< family and value, as friction_14
  std::vector<std::string> settings;
};

/// Parameters and boundaries; towards what discrete elements do: spheres lie lower than SPH, other grains higher.
std::vector<Change> physical_changes(const StudyColumn& column) {
  std::vector<Change> list = {{"base", {}}};
  const auto each = [&](const std::string& family, const std::string& key,
                        const std::vector<std::string>& values) {
    for (const auto& value : values) list.push_back({family + "_" + value, {key + "=" + value}});
  };
  const bool spheres = column.shape() == "SS";
  using Values = std::vector<std::string>;
  each("friction", "material.phi", spheres ? Values{"14", "11", "8", "6"} : Values{"28", "31", "34"});
  each("dilatancy", "material.A_d", spheres ? Values{"0"} : Values{"0.5", "2"});
  each("interlocking", "material.n_p", spheres ? Values{"0"} : Values{"1", "5"});
  each("packing", "material.void_ratio", {"0.7"}); // critical
  if (const auto released = set_settings("dem_packing", column)) list.push_back({"packing_dem", *released});
  each("rest", "initial_stress.K0", {"0.3", "0.8"});
  each("floor", "floor.friction", {"0.1", "0.2", "no-slip"});
  each("glue", "material.p_min", {"0.1", "10"});
  return list;
}

/// The scheme; `all`: also what takes long.
std::vector<Change> numerical_changes(double spacing, bool all) {
  std::vector<Change> list;
  const auto each = [&](const std::string& family, const std::string& key,
                        const std::vector<std::string>& values) {
    for (const auto& value : values) list.push_back({family + "_" + value, {key + "=" + value}});
  };
  each("flowviscosity", "numerics.flow_viscosity", {"0", "50"});
  each("smoothing", "numerics.smoothing_length", {"1.2", "2"});
  each("diffusion", "numerics.stress_diffusion", {"0"});
  each("step", "numerics.step_factor", {"0.2"});
  list.push_back({"spacing_coarse", {fmt::format("scene.spacing={}", 2 * spacing)}});
  list.push_back({"spacing_fine", {fmt::format("scene.spacing={}", 0.5 * spacing)}});
  if (!all) return list;
  const auto coarse = fmt::format("scene.spacing={}", 1.25 * spacing);
  list.push_back({"dimension_2", {coarse}});
  list.push_back({"dimension_3", {coarse, "scene.geometry=three_dimensional", "scene.sector=quarter"}});
  return list;
}

/// Columns that differ most from discrete elements of the same grains.
constexpr std::array columns_of_study = {"ss_dense_a0.5", "ss_dense_a1", "ts_dense_a1", "es_loose_a1"};

} // namespace

void study_causes(const CauseStudyOptions& options) {
  std::vector<StudyRun> runs;
  for (const std::string name : columns_of_study) {
    const auto column = study_columns_of(options.study.data, name).at(0);
    auto changes = physical_changes(column);
    for (auto& change : numerical_changes(options.spacing, name == columns_of_study[0]))
      changes.push_back(std::move(change));
    for (const auto& change : changes) {
      std::vector<std::string> settings = {"material.file=" + calibrated_material(column),
                                           fmt::format("scene.spacing={}", options.spacing)};
      settings.insert(settings.end(), change.settings.begin(), change.settings.end());
      const auto run = name + "/" + change.name;
      runs.push_back({run, column.scene, (std::filesystem::path(options.study.folder) / run).string(),
                      std::move(settings)});
    }
  }
  run_and_report(std::move(runs), "study_causes.py", options.study);
}

} // namespace drivers
