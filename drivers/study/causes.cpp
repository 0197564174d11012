// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/causes.hpp"
#include "drivers/study/columns.hpp"
#include <filesystem>
#include <fmt/format.h>

namespace drivers {
namespace {

struct Change {
  std::string name; ///< family and value, as friction_14
  std::vector<std::string> settings;
};

/// `all`: also those that take long.
std::vector<Change> changes(double spacing, bool all) {
  std::vector<Change> list = {{"base", {}}};
  const auto each = [&](const std::string& family, const std::string& key,
                        const std::vector<std::string>& values) {
    for (const auto& value : values) list.push_back({family + "_" + value, {key + "=" + value}});
  };
  each("friction", "material.phi", {"14", "11", "8", "6"}); // of the critical state, degrees
  each("dilatancy", "material.A_d", {"0"});
  each("interlocking", "material.n_p", {"0"});
  each("packing", "material.void_ratio", {"0.7"}); // critical
  each("floor", "floor.friction", {"0.1", "0.2", "no-slip"});
  each("glue", "material.p_min", {"0.1", "10"});
  each("flowviscosity", "numerics.flow_viscosity", {"0", "50"});
  each("smoothing", "numerics.smoothing_length", {"1.2", "2"});
  each("diffusion", "numerics.stress_diffusion", {"0"});
  each("step", "numerics.step_factor", {"0.2"});
  list.push_back({"spacing_coarse", {fmt::format("scene.spacing={}", 2 * spacing)}});
  if (!all) return list;
  list.push_back({"spacing_fine", {fmt::format("scene.spacing={}", 0.5 * spacing)}});
  const auto coarse = fmt::format("scene.spacing={}", 1.25 * spacing);
  list.push_back({"dimension_2", {coarse}});
  list.push_back({"dimension_3", {coarse, "scene.geometry=three_dimensional", "scene.sector=quarter"}});
  return list;
}

} // namespace

void study_causes(const CauseStudyOptions& options) {
  std::vector<StudyRun> runs;
  for (const auto& column : study_columns_of(options.study.data, "ss_dense_a")) {
    const bool low = column.aspect() == "0.5"; // where the error is largest
    if (!low && column.aspect() != "1") continue;
    for (const auto& change : changes(options.spacing, low)) {
      std::vector<std::string> settings = {"material.file=" + calibrated_material(column),
                                           fmt::format("scene.spacing={}", options.spacing)};
      settings.insert(settings.end(), change.settings.begin(), change.settings.end());
      const auto name = column.name + "/" + change.name;
      runs.push_back({name, column.scene, (std::filesystem::path(options.study.folder) / name).string(),
                      std::move(settings)});
    }
  }
  run_and_report(std::move(runs), "study_causes.py", options.study);
}

} // namespace drivers
