// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/propagate.hpp"
#include "calibration/stored_posterior.hpp"
#include "drivers/files/csv_write.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/tolerance/deposit.hpp"
#include "host/files/result_read.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <gsl/gsl_statistics_double.h>
#include <limits>
#include <optional>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace calibration {
namespace {

namespace fs = std::filesystem;

/// One set of parameters and the result of its run.
struct ParameterSet {
  std::size_t row = 0; ///< of the samples
  drivers::StudyRun run;
  std::optional<drivers::Deposit> deposit; ///< none: the run failed
  drivers::Outline history{};              ///< height, m, over time, s
};

std::vector<ParameterSet> drawn_sets(const PropagateOptions& options, const StoredPosterior& posterior) {
  std::vector<ParameterSet> sets;
  for (const auto row : draw_rows(posterior, options.sets, options.seed)) {
    const auto name = fmt::format("{:03}", sets.size() + 1);
    ParameterSet set{
        row, {name, options.scene, options.study.folder + "/sets/" + name, options.settings}, {}};
    for (std::size_t k = 0; k < posterior.names.size(); ++k)
      set.run.settings.push_back(
          fmt::format("material.{}={}", posterior.names[k], drivers::toml_number(posterior.samples[row][k])));
    set.run.settings.push_back("output.snapshot_interval=1000.0");
    sets.push_back(std::move(set));
  }
  return sets;
}

drivers::Outline history_of(const fs::path& result) {
  drivers::Outline history;
  for (const auto& [quantity, values] : host::read_stored_run(result).series) {
    if (quantity.name == "time") history.radii = values;
    if (quantity.name == "height") history.heights = values;
  }
  return history;
}

/// Runs all sets. Failed ones are reported and stay without a deposit.
void run_sets(std::vector<ParameterSet>& sets, const drivers::StudyOptions& study) {
  std::vector<drivers::StudyRun> runs;
  for (const auto& set : sets) runs.push_back(set.run);
  try {
    drivers::run_missing(runs, study);
  } catch (const std::runtime_error& error) {
    spdlog::warn("{}", error.what());
  }
  for (auto& set : sets) {
    const auto result = fs::path(set.run.folder) / "result.h5";
    if (!host::is_complete_result(result)) continue;
    set.deposit = drivers::read_deposit(result);
    set.history = history_of(result);
  }
}

/// Quantiles of 5, 50 and 95 %.
struct Quantiles {
  double lower = 0, median = 0, upper = 0;
};

Quantiles quantiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return gsl_stats_quantile_from_sorted_data(values.data(), 1, values.size(), q);
  };
  return {at(0.05), at(0.5), at(0.95)};
}

std::vector<double> over_sets(const std::vector<ParameterSet>& sets,
                              const std::function<double(const ParameterSet&)>& value) {
  std::vector<double> values;
  for (const auto& set : sets)
    if (set.deposit) values.push_back(value(set));
  return values;
}

drivers::CsvWriter sets_table(const std::vector<ParameterSet>& sets, const StoredPosterior& posterior) {
  drivers::CsvWriter csv("set,sample,failed," + drivers::joined(posterior.names, ",") +
                         ",height,radius,rest_s");
  constexpr double none = std::numeric_limits<double>::quiet_NaN(); // an empty cell
  for (const auto& set : sets) {
    csv.cell(set.run.name);
    csv.cell(set.row);
    csv.cell(!set.deposit);
    for (const double value : posterior.samples[set.row]) csv.cell(drivers::Rounded{value, 8});
    const auto& d = set.deposit;
    for (const double value : {d ? d->height : none, d ? d->radius : none, d ? d->rest : none})
      csv.cell(drivers::Rounded{value});
    csv.end_row();
  }
  return csv;
}

void add_row(drivers::CsvWriter& csv, const auto& first, const Quantiles& q) {
  csv.row(first, drivers::Rounded{q.lower}, drivers::Rounded{q.median}, drivers::Rounded{q.upper});
}

drivers::CsvWriter bands_table(const std::vector<std::pair<std::string, Quantiles>>& bands) {
  drivers::CsvWriter csv("quantity,lower_5,median,upper_95");
  for (const auto& [name, q] : bands) add_row(csv, name, q);
  return csv;
}

/// Bands of curves at equally spaced places from 0 to `end`. Beyond its own end a curve keeps its last value if
/// `keep_last`, otherwise it is 0.
drivers::CsvWriter curve_bands(const std::vector<ParameterSet>& sets, const std::string& place_name,
                               double end, bool keep_last,
                               const std::function<const drivers::Outline&(const ParameterSet&)>& curve) {
  constexpr int parts = 200;
  drivers::CsvWriter csv(place_name + ",lower_5,median,upper_95");
  for (int k = 0; k <= parts; ++k) {
    const double place = end * k / parts;
    const auto q = quantiles(over_sets(sets, [&](const ParameterSet& set) {
      const auto& c = curve(set);
      return keep_last && place >= c.radii.back() ? c.heights.back() : c.at(place);
    }));
    add_row(csv, drivers::Rounded{place}, q);
  }
  return csv;
}

void write_curves(const std::vector<ParameterSet>& sets, double radius, const fs::path& folder) {
  const auto ends = over_sets(sets, [](const ParameterSet& s) { return s.history.radii.back(); });
  const auto reaches = over_sets(sets, [](const ParameterSet& s) { return s.deposit->radius; });
  const double end = *std::max_element(ends.begin(), ends.end());
  const double reach = 1.1 * radius * *std::max_element(reaches.begin(), reaches.end());
  curve_bands(sets, "radius_m", reach, false, [](const ParameterSet& s) -> const drivers::Outline& {
    return s.deposit->outline;
  }).write(folder / "outline_bands.csv");
  curve_bands(sets, "time_s", end, true, [](const ParameterSet& s) -> const drivers::Outline& {
    return s.history;
  }).write(folder / "height_bands.csv");
}

void print_bands(const std::vector<std::pair<std::string, Quantiles>>& bands, std::size_t complete,
                 const PropagateOptions& options) {
  fmt::print("\n{} of {} sets ran to the end{}; 5, 50 and 95 % of them:\n", complete, options.sets,
             complete < std::size_t(options.sets) ? ", the others failed and are not in the bands" : "");
  for (const auto& [name, q] : bands)
    fmt::print("{:<12}{:>10.4f}{:>10.4f}{:>10.4f}\n", name, q.lower, q.median, q.upper);
  fmt::print("results: {}\n", options.study.folder);
}

/// Warns where a parameter of the scene is outside of all samples: the scene may be of another sand.
void warn_of_other_sand(const host::Scene& scene, const StoredPosterior& posterior) {
  for (std::size_t k = 0; k < posterior.names.size(); ++k) {
    const auto& name = posterior.names[k];
    const double here = scene.material.properties[std::size_t(simsand::parameter_index(name))];
    const auto [least, most] = std::minmax_element(posterior.samples.begin(), posterior.samples.end(),
                                                   [k](const auto& a, const auto& b) { return a[k] < b[k]; });
    if (here < (*least)[k] || here > (*most)[k])
      spdlog::warn("{} = {:g} of the scene is outside of all samples, {:g} to {:g}, which replace it: is it "
                   "the same sand?",
                   name, here, (*least)[k], (*most)[k]);
  }
}

} // namespace

void propagate(PropagateOptions options) {
  const auto posterior = read_posterior(options.posterior);
  const auto scene = drivers::read_scene(options.scene, options.settings);
  require_fit_for(scene, posterior);
  warn_of_other_sand(scene, posterior);
  if (!posterior.converged)
    spdlog::warn("{}: its chain has not converged, by the diagnosis of the fit", options.posterior);
  auto& folder = options.study.folder;
  if (folder.empty()) folder = scene.output_folder;
  auto sets = drawn_sets(options, posterior);
  run_sets(sets, options.study);
  sets_table(sets, posterior).write(fs::path(folder) / "sets.csv");
  const auto heights = over_sets(sets, [](const ParameterSet& s) { return s.deposit->height; });
  if (heights.size() < 2)
    throw std::runtime_error(
        fmt::format("{}: expected at least two sets to run to the end, found {}", folder, heights.size()));
  const std::vector<std::pair<std::string, Quantiles>> bands{
      {"h_f/r0", quantiles(heights)},
      {"r_f/r0", quantiles(over_sets(sets, [](const ParameterSet& s) { return s.deposit->radius; }))}};
  bands_table(bands).write(fs::path(folder) / "bands.csv");
  write_curves(sets, scene.column.radius, folder);
  drivers::report_study("posterior.py", options.study);
  print_bands(bands, heights.size(), options);
}

} // namespace calibration
