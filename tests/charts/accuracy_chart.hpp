// SPDX-License-Identifier: BSD-3-Clause
// `simsand-chart accuracy`: what accuracy costs. Runs columns in many configurations, compares each with the finest run
// and with discrete elements, and draws cost against error. Results and their reading: tests/charts/ACCURACY.md.
#pragma once
#include "drivers/study/runs.hpp"

namespace drivers {

struct AccuracyChartOptions {
  StudyOptions study{"results/accuracy", ""};
  bool quick = false; ///< a few coarse runs
};

/// Runs what is missing, writes runs.csv, points.csv and the pictures. Runs that fail are rows of the table. Throws
/// std::runtime_error if there is no finest run to compare with.
void chart_accuracy(const AccuracyChartOptions& options);

} // namespace drivers
