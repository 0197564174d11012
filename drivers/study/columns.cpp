// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/columns.hpp"
#include "drivers/toml_table.hpp"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

/// Names of the scenes of the 24 columns, sorted.
std::vector<std::string> column_names(const ColumnStudyOptions& options) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(options.study.data) / "scenes")) {
    const auto name = entry.path().stem().string();
    const bool column = entry.path().extension() == ".toml" && name.find("se_a") != name.npos;
    if (column && name.find(options.only) != name.npos) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  if (names.empty())
    throw std::runtime_error(fmt::format(
        "{}/scenes: expected scenes named like ss_dense_a1.toml{}, found none", options.study.data,
        options.only.empty() ? "" : " with '" + options.only + "' in the name"));
  return names;
}

/// What distinguishes a parameter set. `void_ratio` is that of the scene.
std::vector<std::string> set_settings(const std::string& set, const std::string& shape, double void_ratio,
                                      const ColumnStudyOptions& options) {
  if (set == "table4") return {};
  // The paper heads its column of porosities "void ratio": the number as printed, taken by its name.
  if (set == "literal") return {fmt::format("material.void_ratio={:.4f}", void_ratio / (1 + void_ratio))};
  const auto file = fs::absolute(fs::path(options.study.data) / "materials" / (shape + "_dem.toml"));
  if (!fs::exists(file))
    throw std::runtime_error(fmt::format("{}: expected the calibrated material of set 'dem', found no file; "
                                         "simsand calibrate writes it",
                                         file.string()));
  return {"material.file=" + file.string()};
}

std::vector<StudyRun> column_runs(const ColumnStudyOptions& options) {
  std::vector<StudyRun> runs;
  for (const auto& set : options.sets)
    for (const auto& name : column_names(options)) {
      const auto file = (fs::path(options.study.data) / "scenes" / (name + ".toml")).string();
      auto shape = name.substr(0, 2);
      std::transform(shape.begin(), shape.end(), shape.begin(), ::toupper);
      const double void_ratio = read_toml(file).table("material").number("void_ratio");
      StudyRun run{set + "/" + name, file, (fs::path(options.study.folder) / set / name).string(),
                   set_settings(set, shape, void_ratio, options)};
      run.settings.push_back(fmt::format("scene.spacing={}", options.spacing));
      run.settings.push_back("output.snapshot_interval=0.02");
      runs.push_back(std::move(run));
    }
  return runs;
}

} // namespace

void study_columns(const ColumnStudyOptions& options) {
  run_missing(column_runs(options), options.study);
  report_study("study_columns.py", options.study);
}

} // namespace drivers
