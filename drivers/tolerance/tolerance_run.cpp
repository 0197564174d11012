// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/tolerance_run.hpp"
#include "drivers/files/csv_write.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/study/runs.hpp"
#include "drivers/tolerance/deposit.hpp"
#include "drivers/tolerance/tolerance_scene.hpp"
#include "host/files/result_read.hpp"
#include "host/files/whole_file.hpp"
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

std::string errors_of(const ChartPoint& p) {
  return fmt::format("h_f {}, r_f {}", percent(p.typical.height), percent(p.typical.radius));
}

/// What was chosen and why, line by line.
Words reasons(const Choice& choice, const ChartData& data, const host::Scene& scene, double tolerance) {
  const auto& c = choice.point.configuration;
  const double needed = scene_resolution(scene, c.resolution), side = size_of(scene.column);
  Words lines;
  lines.push_back(fmt::format(
      "tolerance {}: {} of {} charted configurations meet it in the middle column; the cheapest is {}, {:g} "
      "particles a side of sqrt(r0 h0)",
      percent(tolerance), choice.meeting, choice.considered, described(c), c.resolution));
  lines.push_back(fmt::format("spacing {:.4g} mm; charted error {} (single runs, middle of {} columns, worst "
                              "h_f {}, r_f {}; against {:g} a side)",
                              1e3 * side / needed, errors_of(choice.point), choice.point.columns,
                              percent(choice.point.error.height), percent(choice.point.error.radius),
                              data.finest(is_plane(c))));
  if (needed > c.resolution)
    lines.push_back(fmt::format("finer than charted by {:.3g}, as the grain is small against the column",
                                needed / c.resolution));
  if (choice.cheaper)
    lines.push_back(fmt::format("the next cheaper one, {}, {:g} a side, errs by {}{}",
                                described(choice.cheaper->configuration),
                                choice.cheaper->configuration.resolution, errors_of(*choice.cheaper),
                                meets(*choice.cheaper, tolerance) ? " but not at finer resolutions" : ""));
  if (choice.simple && choice.simple->typical.larger() > tolerance)
    lines.push_back(fmt::format("SIMSAND stays: {} errs by {} at best", choice.simple->configuration.material,
                                errors_of(*choice.simple)));
  for (const auto& remark : beyond_the_chart(scene)) lines.push_back("not in the chart: " + remark);
  return lines;
}

bool is_complete_run_of(const host::Scene& scene) {
  const auto result = fs::path(scene.output_folder) / "result.h5";
  return host::is_complete_result(result) && host::stored_scene(result) == scene.resolved;
}

/// The run itself, unless its result is there, and its companion as a program of its own. In this order.
void run_both(const std::string& base, const fs::path& folder, const Words& fine, const Words& coarse,
              const RunOptions& options, const std::string& data) {
  auto settings = fine;
  settings.push_back("output.folder=" + folder.string());
  const auto scene = read_scene(base, settings);
  if (!is_complete_run_of(scene)) run_scene(scene, options);
  const StudyOptions study{folder.string(), data, 1, true};
  if (!options.quiet) spdlog::info("companion: {:.4g} times the spacing", companion_ratio);
  run_missing({{"companion", base, (folder / "companion").string(), coarse}}, study);
}

std::vector<Estimate> estimates(const fs::path& folder, const ChartPoint& point, const Interval& interval) {
  const auto fine = read_deposit(folder / "result.h5"), coarse = read_deposit(folder / "companion/result.h5");
  const auto estimate = [](const char* name, double value, double companion, double chart, double factor) {
    return Estimate{name, value, companion, chart, half_width(factor, chart, companion / value - 1)};
  };
  return {estimate("h_f/r0", fine.height, coarse.height, point.error.height, interval.factor.height),
          estimate("r_f/r0", fine.radius, coarse.radius, point.error.radius, interval.factor.radius)};
}

void write_estimates(const fs::path& file, const std::vector<Estimate>& all, const Words& why,
                     double tolerance) {
  Words comments = why;
  comments.push_back(fmt::format("tolerance: {:g}", tolerance));
  CsvWriter table("quantity,value,lower,upper,half_width,companion,chart_error", comments);
  for (const auto& e : all)
    table.row(e.quantity, Rounded{e.value}, Rounded{e.lower()}, Rounded{e.upper()}, Rounded{e.half_width, 4},
              Rounded{e.companion}, Rounded{e.chart_error, 4});
  table.write(file);
}

void print_estimates(const std::vector<Estimate>& all, const Interval& interval, double tolerance,
                     const fs::path& file) {
  fmt::print("\n{:<10}{:>10}{:>22}{:>12}{:>12}\n", "", "value", "interval", "error", "companion");
  bool within = true;
  for (const auto& e : all) {
    fmt::print("{:<10}{:>10.4f}{:>22}{:>12}{:>12.4f}\n", e.quantity, e.value,
               fmt::format("{:.4f} to {:.4f}", e.lower(), e.upper()), "+- " + percent(e.half_width),
               e.companion);
    within = within && e.half_width <= tolerance;
  }
  const auto evidence =
      interval.pairs > 0
          ? fmt::format("Of {} pairs of the chart, each judged by the other columns, such intervals hold the "
                        "finest run in {:.0f} %.",
                        interval.pairs, 100 * held_share)
          : std::string("The chart has one column for this flow: nothing has tested the intervals.");
  fmt::print("{}{}\nestimate: {}\n", evidence,
             within ? ""
                    : fmt::format("\nThey are wider than the tolerance of {}: the run may miss it.",
                                  percent(tolerance)),
             file.string());
}

} // namespace

double read_tolerance(const std::string& text) {
  const bool in_percent = text.ends_with('%');
  const char *begin = text.data(), *end = begin + text.size() - in_percent;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  const double share = in_percent ? value / 100 : value;
  if (error != std::errc() || stop != end || !(share > 0) || share > 0.5)
    throw std::runtime_error(
        fmt::format("--tolerance: expected a share above 0 and up to 0.5, as 5% or 0.05, found '{}'", text));
  return share;
}

std::vector<Estimate> run_to_tolerance(const ToleranceOptions& options, const RunOptions& run) {
  const auto scene = read_scene_to_choose(options.scene, options.settings);
  const fs::path folder = options.folder.empty() ? scene.output_folder : options.folder;
  const ChartData data(read_chart_table(fs::path(options.data) / "accuracy/runs.csv"));
  const bool plane = scene.geometry == host::GeometryKind::plane_strain;
  const auto choice = choose(data, plane, options.tolerance);
  const auto interval = calibrate_interval(data, plane);
  const auto why = reasons(choice, data, scene, options.tolerance);
  for (const auto& line : why) spdlog::info("{}", line);

  auto fine = choice.point.configuration;
  fine.resolution = scene_resolution(scene, fine.resolution);
  const auto coarse = at_resolution(fine, fine.resolution / companion_ratio);
  fs::create_directories(folder);
  const auto base = (folder / "scene_for_tolerance.toml").string();
  host::write_whole(base, scene_without_choice(scene, fine));
  run_both(base, folder, settings_of(fine, scene, options.data), settings_of(coarse, scene, options.data),
           run, options.data);

  const auto found = estimates(folder, choice.point, interval);
  write_estimates(folder / "accuracy.csv", found, why, options.tolerance);
  print_estimates(found, interval, options.tolerance, folder / "accuracy.csv");
  return found;
}

} // namespace drivers
