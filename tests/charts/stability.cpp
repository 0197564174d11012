// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/stability.hpp"
#include "host/files/whole_file.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <omp.h>
#include <set>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace charts {
namespace {

std::string settings_of(const StabilityCase& c) {
  const bool plane = c.geometry == host::GeometryKind::plane_strain;
  return fmt::format("{},{},{},{:g},{:g},{:g},{:g}", c.material,
                     plane ? host::PlaneStrain::name : host::Axisymmetric::name, c.particles_per_radius,
                     c.smoothing_length, c.viscosity, c.stress_diffusion, c.step_factor);
}

std::string row_of(const StabilityCase& c, const StabilityOutcome& o) {
  std::string row =
      fmt::format("{},{},{},{:.4g},{}", settings_of(c), o.particles, o.steps, o.end_time, o.ended);
  for (const double value : {o.imbalance, o.made, o.kinetic_peak, o.kinetic_start, o.kinetic_end, o.thrown,
                             o.noise, o.height, o.front})
    row += fmt::format(",{:.4g}", value);
  return row + ',' + o.verdict;
}

constexpr int setting_columns = 7, columns = 21;

/// The first `n` entries of a row.
std::string first_entries(const std::string& row, int n) {
  std::size_t at = 0;
  for (int k = 0; k < n; ++k) at = row.find(',', at) + 1;
  return row.substr(0, at - 1);
}

/// Rows of an earlier part, by their settings. A line that was cut off when the program ended is left out.
std::map<std::string, std::string> earlier_rows(const std::filesystem::path& file) {
  std::map<std::string, std::string> rows;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) return rows;
  if (line != stability_header)
    throw std::runtime_error(file.string() + ":1: expected the columns of this chart (--afresh replaces it)");
  while (std::getline(in, line))
    if (!in.eof() && std::count(line.begin(), line.end(), ',') == columns - 1)
      rows[first_entries(line, setting_columns)] = line;
  return rows;
}

/// The table in the order of the grid, as a whole file.
void write_table(const std::vector<StabilityCase>& grid, const std::map<std::string, std::string>& rows,
                 const std::filesystem::path& file) {
  std::string text = std::string(stability_header) + '\n';
  for (const auto& c : grid)
    if (const auto row = rows.find(settings_of(c)); row != rows.end()) text += row->second + '\n';
  host::write_whole(file, text);
}

void print_summary(const std::vector<StabilityCase>& grid, const std::map<std::string, std::string>& rows) {
  std::map<std::string, std::map<std::string, int>> counts; // [material, geometry][verdict]
  std::set<std::string> verdicts;
  for (const auto& c : grid) {
    const auto& row = rows.at(settings_of(c));
    const auto verdict = row.substr(row.rfind(',') + 1);
    ++counts[first_entries(row, 2)][verdict];
    verdicts.insert(verdict);
  }
  for (auto& [group, by_verdict] : counts) {
    fmt::print("{:<24}", group);
    for (const auto& verdict : verdicts) fmt::print("  {} {}", verdict, by_verdict[verdict]);
    fmt::print("\n");
  }
}

} // namespace

std::vector<StabilityCase> stability_grid(bool quick) {
  using Values = std::vector<double>;
  const std::vector<int> particles = quick ? std::vector{6} : std::vector{6, 10, 15};
  const Values lengths = quick ? Values{1.5} : Values{1.1, 1.5, 2.2};
  const Values viscosities = quick ? Values{0, 1} : Values{0, 0.2, 1, 5};
  const Values diffusions = quick ? Values{5} : Values{0, 5, 25};
  const Values steps = quick ? Values{0.4, 4.8} : Values{0.4, 0.8, 1.2, 1.6, 2, 2.4, 3.2};
  std::vector<StabilityCase> grid;
  for (const std::string material : {"simsand", "elastic"})
    for (const auto geometry : {host::GeometryKind::plane_strain, host::GeometryKind::axisymmetric})
      for (const int n : particles)
        for (const double h : lengths)
          for (const double viscosity : viscosities)
            for (const double diffusion : diffusions)
              for (const double step : steps)
                grid.push_back({material, geometry, n, h, viscosity, diffusion, step});
  return grid;
}

void chart_stability(const StabilityOptions& options) {
  const auto grid = stability_grid(options.quick);
  const auto file = options.folder / "stability.csv";
  std::filesystem::create_directories(options.folder);
  const host::FolderLock lock(options.folder, file);
  auto rows = options.afresh ? std::map<std::string, std::string>{} : earlier_rows(file);
  std::vector<StabilityCase> left;
  for (const auto& c : grid)
    if (!rows.contains(settings_of(c))) left.push_back(c);
  write_table(grid, rows, file);
  std::ofstream out(file, std::ios::app);
  std::size_t done = 0;
  auto last = std::chrono::steady_clock::now();
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < left.size(); ++k) {
    const auto row = row_of(left[k], run_stability_case(left[k]));
#pragma omp critical
    {
      rows[settings_of(left[k])] = row;
      out << row << std::endl; // known to the disk before the next one
      ++done;
      if (const auto now = std::chrono::steady_clock::now(); now - last > std::chrono::seconds(10)) {
        last = now;
        spdlog::info("{} of {} runs", grid.size() - left.size() + done, grid.size());
      }
    }
  }
  out.close();
  write_table(grid, rows, file);
  print_summary(grid, rows);
  fmt::print("{} runs, {} of them now: {}\n", grid.size(), left.size(), file.string());
}

} // namespace charts
