// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/columns.hpp"
#include "drivers/files/toml_table.hpp"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

constexpr double sensitivity_spacing = 2e-3; ///< m: sensitivities run no finer if they can run coarser

/// Whether the set runs at this spacing: a sensitivity leaves out fine ones, unless nothing coarser is asked for.
bool has_spacing(const std::string& set, double spacing, const std::vector<double>& spacings) {
  const double coarsest = *std::max_element(spacings.begin(), spacings.end());
  return !is_sensitivity(set) || spacing >= std::min(sensitivity_spacing, coarsest);
}

StudyRun run_of(const StudyColumn& column, const std::string& set, double spacing,
                std::vector<std::string> settings, const ColumnStudyOptions& options) {
  settings.push_back(fmt::format("scene.spacing={}", spacing));
  settings.push_back("output.snapshot_interval=0.02");
  const auto name = fmt::format("{:g}mm/{}/{}", 1e3 * spacing, set, column.name);
  return {name, column.scene, (fs::path(options.study.folder) / name).string(), std::move(settings)};
}

std::vector<StudyRun> column_runs(const ColumnStudyOptions& options, double spacing) {
  std::vector<StudyRun> runs;
  for (const auto& set : options.sets)
    for (const auto& column : study_columns_of(options.study.data, options.only))
      if (has_spacing(set, spacing, options.spacings))
        if (auto settings = set_settings(set, column))
          runs.push_back(run_of(column, set, spacing, std::move(*settings), options));
  return runs;
}

} // namespace

std::vector<StudyColumn> study_columns_of(const std::string& data, const std::string& only) {
  std::vector<StudyColumn> columns;
  for (const auto& entry : fs::directory_iterator(fs::path(data) / "scenes")) {
    const auto name = entry.path().stem().string();
    const bool loose_or_dense = name.find("_dense_a") == 2 || name.find("_loose_a") == 2;
    const bool axisymmetric = name.find_last_not_of("0123456789.") == name.rfind("_a") + 1; // no suffix
    if (entry.path().extension() != ".toml" || !loose_or_dense || !axisymmetric) continue;
    if (name.find(only) == name.npos) continue;
    const auto file = entry.path().string();
    columns.push_back({name, file, data, read_toml(file).table("material").number("void_ratio")});
  }
  std::sort(columns.begin(), columns.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  if (columns.empty())
    throw std::runtime_error(
        fmt::format("{}/scenes: expected scenes named like ss_dense_a1.toml{}, found none", data,
                    only.empty() ? "" : " with '" + only + "' in the name"));
  return columns;
}

void study_columns(const ColumnStudyOptions& options) {
  std::vector<StudyRun> runs;
  for (double spacing : options.spacings)
    for (auto& run : column_runs(options, spacing)) runs.push_back(std::move(run));
  run_and_report(std::move(runs), "study_columns.py", options.study);
}

} // namespace drivers
