// SPDX-License-Identifier: BSD-3-Clause
// The runs of the chart of accuracy: columns, configurations, repetitions that differ in the step alone.
#pragma once
#include "drivers/tolerance/configuration.hpp"
#include <vector>

namespace drivers {

/// A column of the chart. Plane strain has a reference of its own.
struct ChartColumn {
  std::string name;  ///< as in the table
  std::string scene; ///< file in data/scenes
  std::string grain; ///< SS, TS, ES
  std::string dem;   ///< file in data/dem/results; may be missing there
};

struct ChartRun {
  ChartColumn column;
  Configuration configuration;
  int repeat = 0; ///< see step_factor

  /// The configuration's step factor times 1, 0.96, 1.04: single runs scatter with the step.
  double step_factor() const;
  std::string name() const;
};

/// All runs; `quick`: a few coarse ones that only show that the chart is made.
std::vector<ChartRun> chart_runs(bool quick);

/// Everything that a run sets in its scene.
Words settings_of(const ChartRun& run, const host::Scene& scene, const std::string& data);

} // namespace drivers
