// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/accuracy_runs.hpp"
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace drivers {
namespace {

/// Three shapes of grains, both packings, aspect ratios 0.5 to 2; discrete elements for as many as there are.
const std::vector<ChartColumn> columns = {
    {"ts_dense_a1", "default.toml", "TS", "column_TS_dense_1.h5"},
    {"ss_loose_a1", "ss_loose_a1.toml", "SS", "column_SS_loose_1.h5"},
    {"es_loose_a0.5", "es_loose_a0.5.toml", "ES", "column_ES_loose_0.5.h5"},
    {"ss_dense_a2", "ss_dense_a2.toml", "SS", "column_SS_dense_2.h5"}};
const ChartColumn plane{"ts_dense_a1_plane", "default.toml", "TS", ""};
/// Resolutions, each 1.25 times the one before: twice the cost.
const std::vector<double> coarse = {8, 10, 12.5, 16, 20, 25};
constexpr double fine = 32, finest = 40;

class List {
public:
  void add(const std::vector<ChartColumn>& where, const Configuration& what,
           const std::vector<double>& resolutions, int repeats) {
    for (const double n : resolutions)
      for (const auto& column : where)
        for (int r = 0; r < repeats; ++r) runs.push_back({column, at_resolution(what, n), r});
  }
  std::vector<ChartRun> runs;
};

void add_solid(List& list) {
  Configuration solid;
  solid.geometry = "quarter";
  list.add({columns[0], columns[1]}, solid, {8}, 1);
  list.add({columns[0]}, solid, {10, 12.5}, 1);
  for (const auto part : {"half", "full"}) {
    solid.geometry = part;
    list.add({columns[0]}, solid, {8}, 1);
  }
}

void add_plane(List& list) {
  Configuration flat;
  flat.geometry = "plane_strain";
  list.add({plane}, flat, coarse, 1);
  list.add({plane}, flat, {fine}, 1);
}

void add_materials(List& list) {
  for (const double scale : {0.1, 0.03}) {
    Configuration softer;
    softer.stiffness_scale = scale;
    list.add(columns, softer, {10, 12.5, 16, 20, 25}, 1);
  }
  Configuration other;
  other.material = "drucker_prager";
  list.add(columns, other, {12.5, 20}, 1);
  other.material = "calibrated";
  list.add(columns, other, {20}, 1);
  Configuration single;
  single.precision = "single";
  list.add(columns, single, {12.5, 20}, 1);
}

/// Step, kernel and its reach: to see, not to choose from.
void add_scheme(List& list) {
  Configuration step, reach, kernel;
  for (const bool more : {false, true}) {
    step.step_factor = more ? 0.8 : 0.2;
    reach.smoothing_length = more ? 1.8 : 1.3;
    list.add(columns, step, {16}, 1);
    list.add(columns, reach, {16}, 1);
  }
  kernel.kernel = "wendland-c4";
  for (const double length : {1.5, 1.8}) {
    kernel.smoothing_length = length;
    list.add(columns, kernel, {16, 25}, 1);
  }
}

std::vector<ChartRun> quick_runs() {
  const std::vector<ChartColumn> two{columns[1], columns[2]};
  Configuration usual, softer;
  softer.stiffness_scale = 0.1;
  List list;
  list.add(two, usual, {5, 8}, 2);
  list.add(two, usual, {12.5}, 1);
  list.add(two, softer, {5, 8}, 1);
  return list.runs;
}

} // namespace

double ChartRun::step_factor() const {
  constexpr std::array<double, 3> parts{1, 0.96, 1.04};
  return configuration.step_factor * parts.at(repeat);
}

std::string ChartRun::name() const {
  return fmt::format("{}/{}_{}", column.name, short_name(configuration), repeat + 1);
}

std::vector<ChartRun> chart_runs(bool quick) {
  if (quick) return quick_runs();
  List list;
  list.add(columns, {}, {8, 10}, 1);
  list.add(columns, {}, {12.5, 16, 20, 25}, 2);
  list.add(columns, {}, {fine}, 1);
  list.add(columns, {}, {finest}, 2);
  add_materials(list);
  add_scheme(list);
  add_solid(list);
  add_plane(list);
  return list.runs;
}

Words settings_of(const ChartRun& run, const host::Scene& scene, const std::string& data) {
  auto configuration = run.configuration;
  configuration.step_factor = run.step_factor();
  auto settings = settings_of(configuration, scene, data);
  if (configuration.material == "calibrated")
    settings.push_back(
        "material.file=" +
        (std::filesystem::absolute(data) / "materials" / (run.column.grain + "_dem.toml")).string());
  settings.push_back("output.snapshot_interval=10.0");
  return settings;
}

} // namespace drivers
