// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/accuracy_chart.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/tolerance/chart_data.hpp"
#include "drivers/tolerance/deposit.hpp"
#include "tests/charts/accuracy_runs.hpp"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

struct Done {
  ChartRun run;
  host::Column column;
  std::optional<Deposit> deposit; ///< none: the run failed
};

StudyRun study_run(const ChartRun& run, const StudyOptions& study) {
  const auto file = (fs::path(study.data) / "scenes" / run.column.scene).string();
  const auto folder = (fs::path(study.folder) / "runs" / run.name()).string();
  return {run.name(), file, folder, settings_of(run, read_scene(file), study.data)};
}

/// Runs that fail stay without a result; the log names them.
void run_all(const std::vector<StudyRun>& runs, const StudyOptions& study) {
  try {
    run_missing(runs, study);
  } catch (const std::runtime_error& error) {
    spdlog::warn("{}", error.what());
  }
}

std::vector<Done> deposits(const std::vector<ChartRun>& runs, const StudyOptions& study) {
  std::vector<Done> done;
  for (const auto& run : runs) {
    const auto one = study_run(run, study);
    Done d{run, read_scene(one.scene).column, {}};
    try {
      d.deposit = read_deposit(fs::path(one.folder) / "result.h5");
    } catch (const std::runtime_error&) {} // no complete result: a failure
    done.push_back(std::move(d));
  }
  return done;
}

/// The mean outline of the finest runs in the default configuration, by column.
std::map<std::string, Outline> finest_outlines(const std::vector<Done>& runs) {
  std::map<std::string, double> finest;
  const auto plain = [](const Done& d) {
    auto usual = at_resolution({}, d.run.configuration.resolution);
    if (d.run.configuration.geometry == "plane_strain") usual.geometry = "plane_strain";
    return d.deposit && d.run.configuration == usual;
  };
  for (const auto& d : runs)
    if (plain(d)) {
      auto& best = finest[d.run.column.name];
      best = std::max(best, d.run.configuration.resolution);
    }
  std::map<std::string, std::vector<Outline>> parts;
  for (const auto& d : runs)
    if (plain(d) && d.run.configuration.resolution == finest[d.run.column.name])
      parts[d.run.column.name].push_back(d.deposit->outline);
  std::map<std::string, Outline> means;
  for (const auto& [name, outlines] : parts) means[name] = mean_outline(outlines);
  return means;
}

void compare_with_dem(const Done& done, const fs::path& data, ChartRow& row) {
  const auto file = data / "dem/results" / done.run.column.dem;
  if (done.run.column.dem.empty() || !fs::exists(file)) return;
  const double radius = done.column.radius, height = done.column.height;
  const auto dem = read_dem_deposit(file, radius);
  row.dem_height = row.height / dem.height - 1;
  row.dem_radius = row.radius / dem.radius - 1;
  row.dem_outline = area_between(done.deposit->outline, dem.outline) / (radius * height);
}

ChartRow row_of(const Done& done, const std::map<std::string, Outline>& finest, const fs::path& data) {
  ChartRow row{done.run.column.name, done.run.configuration, done.run.repeat, !done.deposit};
  if (!done.deposit) return row;
  const auto& d = *done.deposit;
  row.particles = d.particles;
  row.steps = d.steps;
  row.seconds = d.seconds;
  row.height = d.height;
  row.radius = d.radius;
  row.rest = d.rest;
  if (const auto at = finest.find(row.column); at != finest.end())
    row.outline_error = area_between(d.outline, at->second) / (done.column.radius * done.column.height);
  compare_with_dem(done, data, row);
  return row;
}

} // namespace

void chart_accuracy(const AccuracyChartOptions& options) {
  const auto runs = chart_runs(options.quick);
  std::vector<StudyRun> study;
  for (const auto& run : runs) study.push_back(study_run(run, options.study));
  run_all(study, options.study);
  const auto done = deposits(runs, options.study);
  const auto finest = finest_outlines(done);
  if (finest.empty())
    throw std::runtime_error(fmt::format("{}: no complete run to compare with", options.study.folder));
  std::vector<ChartRow> rows;
  double seconds = 0;
  for (const auto& d : done) {
    rows.push_back(row_of(d, finest, options.study.data));
    if (d.deposit) seconds += d.deposit->seconds;
  }
  write_chart_table(fs::path(options.study.folder) / "runs.csv", rows);
  write_points(fs::path(options.study.folder) / "points.csv", ChartData(rows));
  if (!options.study.quiet) spdlog::info("{} runs, {:.0f} s of processor", rows.size(), seconds);
  report_study("accuracy.py", options.study);
}

} // namespace drivers
