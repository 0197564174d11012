// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/chart_data.hpp"
#include "drivers/files/csv_write.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <stdexcept>

namespace drivers {
namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? ChartRow::unknown : sum / double(values.size());
}

double root_mean_square(std::vector<double> values) {
  for (double& v : values) v *= v;
  return std::sqrt(mean_of(values));
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The default configuration of a row's flow at its resolution.
bool is_default(const ChartRow& row) {
  auto usual = at_resolution({}, row.configuration.resolution);
  if (is_plane(row.configuration)) usual.geometry = "plane_strain";
  return row.configuration == usual;
}

/// What the rate of a run depends on.
Configuration kind_of_rate(Configuration c) {
  c.stiffness_scale = c.step_factor = 0;
  return c;
}

/// Deviation of the values from the means of their groups, n - 1 for each group.
double pooled_scatter(const std::map<std::string, std::vector<double>>& groups) {
  double squares = 0;
  std::size_t free = 0;
  for (const auto& [name, values] : groups) {
    const double mean = mean_of(values);
    for (const double v : values) squares += (v - mean) * (v - mean);
    free += values.size() - 1;
  }
  return free > 0 ? std::sqrt(squares / double(free)) : ChartRow::unknown;
}

} // namespace

bool is_plane(const Configuration& configuration) {
  return configuration.geometry == "plane_strain";
}

ChartData::ChartData(std::vector<ChartRow> rows) : runs(std::move(rows)) {
  find_references();
  if (reference.empty())
    throw std::runtime_error("the chart's data hold no run in the default configuration");
  std::map<Configuration, std::vector<double>> rates;
  for (const auto& row : runs)
    if (!row.failed)
      rates[kind_of_rate(row.configuration)].push_back(row.particles * row.steps / row.seconds);
  for (const auto& [kind, values] : rates) rate[kind] = median_of(values);
  std::map<std::string, double> coarsest;
  for (const auto& row : runs) {
    if (row.failed || !is_default(row)) continue;
    auto& n = coarsest.try_emplace(row.column, INFINITY).first->second;
    if (row.configuration.resolution >= n) continue;
    n = row.configuration.resolution;
    base_seconds[row.column] = seconds_of(row);
  }
  std::set<Configuration> configurations;
  for (const auto& row : runs) configurations.insert(row.configuration);
  for (const auto& c : configurations) all.push_back(point_of(c));
}

void ChartData::find_references() {
  const auto usable = [](const ChartRow& row) { return !row.failed && is_default(row); };
  for (const auto& row : runs) {
    if (!usable(row)) continue;
    auto& most = reference_resolution[row.column];
    most = std::max(most, row.configuration.resolution);
  }
  std::map<std::string, std::vector<double>> heights, radii;
  for (const auto& row : runs)
    if (usable(row) && row.configuration.resolution == reference_resolution.at(row.column)) {
      heights[row.column].push_back(row.height);
      radii[row.column].push_back(row.radius);
      in_plane[row.column] = is_plane(row.configuration);
    }
  for (const auto& [name, values] : heights) reference[name] = {mean_of(values), mean_of(radii[name])};
}

double ChartData::finest(bool plane) const {
  double least = INFINITY;
  for (const auto& [name, resolution] : reference_resolution)
    if (in_plane.at(name) == plane) least = std::min(least, resolution);
  return least;
}

HeightRadius ChartData::error(const ChartRow& row) const {
  const auto at = reference.find(row.column);
  if (at == reference.end() || row.failed) return {ChartRow::unknown, ChartRow::unknown};
  return {row.height / at->second.height - 1, row.radius / at->second.radius - 1};
}

std::pair<std::vector<double>, std::vector<double>>
ChartData::column_errors(const Configuration& configuration, const std::string& without) const {
  std::map<std::string, std::vector<double>> heights, radii;
  for (const auto& row : runs) {
    if (row.configuration != configuration || row.column == without || row.failed) continue;
    const auto e = error(row);
    heights[row.column].push_back(e.height);
    radii[row.column].push_back(e.radius);
  }
  std::vector<double> h, r;
  for (const auto& [name, values] : heights) {
    h.push_back(root_mean_square(values));
    r.push_back(root_mean_square(radii[name]));
  }
  std::sort(h.begin(), h.end());
  std::sort(r.begin(), r.end());
  return {h, r};
}

HeightRadius ChartData::worst_error(const Configuration& configuration, const std::string& without) const {
  const auto [h, r] = column_errors(configuration, without);
  return h.empty() ? HeightRadius{INFINITY, INFINITY} : HeightRadius{h.back(), r.back()};
}

HeightRadius ChartData::typical_error(const Configuration& configuration, const std::string& without) const {
  const auto [h, r] = column_errors(configuration, without);
  if (h.empty()) return {INFINITY, INFINITY};
  const auto middle = [](const std::vector<double>& v) {
    return (v[(v.size() - 1) / 2] + v[v.size() / 2]) / 2;
  };
  return {middle(h), middle(r)};
}

double ChartData::seconds_of(const ChartRow& row) const {
  return row.particles * row.steps / rate.at(kind_of_rate(row.configuration));
}

double ChartData::cost_over_all(const Configuration& configuration) const {
  std::vector<double> over_base, base;
  for (const auto& row : runs)
    if (row.configuration == configuration && !row.failed)
      over_base.push_back(seconds_of(row) / base_seconds.at(row.column));
  for (const auto& [name, seconds] : base_seconds)
    if (in_plane.at(name) == is_plane(configuration)) base.push_back(seconds);
  return mean_of(over_base) * mean_of(base);
}

ChartPoint ChartData::point_of(const Configuration& configuration) const {
  ChartPoint point;
  point.configuration = configuration;
  point.error = worst_error(configuration);
  point.typical = typical_error(configuration);
  std::map<std::string, std::vector<double>> heights, radii;
  std::vector<double> h, r, outline, dem_h, dem_r, dem_outline, steps;
  for (const auto& row : runs) {
    if (row.configuration != configuration) continue;
    ++point.runs;
    point.failures += row.failed;
    if (row.failed) continue;
    const auto e = error(row);
    heights[row.column].push_back(e.height);
    radii[row.column].push_back(e.radius);
    h.push_back(e.height);
    r.push_back(e.radius);
    outline.push_back(row.outline_error);
    steps.push_back(row.particles * row.steps);
    if (!std::isfinite(row.dem_height)) continue;
    dem_h.push_back(std::abs(row.dem_height));
    dem_r.push_back(std::abs(row.dem_radius));
    dem_outline.push_back(row.dem_outline);
  }
  point.columns = int(heights.size());
  point.mean = {mean_of(h), mean_of(r)};
  point.scatter = {pooled_scatter(heights), pooled_scatter(radii)};
  point.outline_error = mean_of(outline);
  point.dem = {mean_of(dem_h), mean_of(dem_r)};
  point.dem_outline = mean_of(dem_outline);
  point.particle_steps = mean_of(steps);
  point.seconds = cost_over_all(configuration);
  return point;
}

void write_points(const std::filesystem::path& file, const ChartData& data) {
  CsvWriter table(
      "geometry,material,precision,stiffness_scale,step_factor,kernel,smoothing_length,resolution,columns,"
      "runs,"
      "failures,particle_steps,seconds,height_error,radius_error,height_typical,radius_typical,height_mean,"
      "radius_mean,height_scatter,radius_scatter,outline_error,dem_height_error,dem_radius_error,"
      "dem_outline_error");
  for (const auto& p : data.points()) {
    const auto& c = p.configuration;
    for (const auto& choice : {c.geometry, c.material, c.precision}) table.cell(choice);
    for (const double choice : {c.stiffness_scale, c.step_factor}) table.cell(Rounded{choice});
    table.cell(c.kernel);
    for (const double choice : {c.smoothing_length, c.resolution}) table.cell(Rounded{choice});
    for (const int count : {p.columns, p.runs, p.failures}) table.cell(count);
    for (const double value : {p.particle_steps, p.seconds, p.error.height, p.error.radius, p.typical.height,
                               p.typical.radius, p.mean.height, p.mean.radius, p.scatter.height,
                               p.scatter.radius, p.outline_error, p.dem.height, p.dem.radius, p.dem_outline})
      table.cell(Rounded{value, 4});
    table.end_row();
  }
  table.write(file);
}

} // namespace drivers
