// SPDX-License-Identifier: BSD-3-Clause
// The table of the chart of accuracy, runs.csv: one row a run. Columns: ACCURACY.md.
#pragma once
#include "drivers/tolerance/configuration.hpp"
#include <filesystem>
#include <limits>
#include <vector>

namespace drivers {

struct ChartRow {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string column;
  Configuration configuration;
  int repeat = 0;
  bool failed = false;                                            ///< then there are no numbers
  double particles = unknown, steps = unknown, seconds = unknown; ///< seconds: of processor
  double height = unknown, radius = unknown;                      ///< h_f and r_f over the initial radius
  double rest = unknown;                                          ///< s
  double outline_error = unknown; ///< area between it and the mean outline of the finest, over r0 h0
  double dem_height = unknown, dem_radius = unknown; ///< errors against discrete elements, relative
  double dem_outline = unknown;                      ///< area between, over r0 h0
};

/// Throws std::runtime_error naming file and line.
std::vector<ChartRow> read_chart_table(const std::filesystem::path& file);

/// Numbers that are not known stay empty. Throws std::runtime_error naming the file.
void write_chart_table(const std::filesystem::path& file, const std::vector<ChartRow>& rows);

} // namespace drivers
