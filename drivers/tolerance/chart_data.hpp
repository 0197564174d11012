// SPDX-License-Identifier: BSD-3-Clause
// What the chart's runs say of a configuration: errors of h_f and r_f against the finest runs of the same column, and cost.
#pragma once
#include "drivers/tolerance/chart_table.hpp"
#include <map>

namespace drivers {

/// A pair of numbers, one for the final height h_f and one for the final radius r_f.
struct HeightRadius {
  double height = 0, radius = 0;
  double larger() const { return height > radius ? height : radius; }
};

/// One configuration over all columns it was run on. Errors are relative.
struct ChartPoint {
  Configuration configuration;
  int columns = 0, runs = 0, failures = 0;
  HeightRadius error; ///< root mean square of the column where it is largest: what a single run may be off by
  HeightRadius typical;       ///< the same of the middle column
  HeightRadius mean, scatter; ///< mean error with its sign; deviation of single runs from their column's mean
  double outline_error = 0;   ///< mean area between outlines, over r0 h0
  HeightRadius dem;           ///< mean magnitude against discrete elements; NaN where there is none
  double dem_outline = 0;
  double particle_steps = 0; ///< mean
  double seconds = 0;        ///< of processor, as if it had been run on all columns
};

class ChartData {
public:
  /// Throws std::runtime_error if there is no run in the default configuration to compare with.
  explicit ChartData(std::vector<ChartRow> rows);

  const std::vector<ChartPoint>& points() const { return all; }
  /// Resolution of the reference, the highest in the default configuration: of the column of the flow where it is least.
  double finest(bool plane) const;
  /// Errors of a run against the finest of its column: run / finest - 1.
  HeightRadius error(const ChartRow& row) const;
  /// Errors of a configuration as in ChartPoint, without one column; of no run: infinite.
  HeightRadius worst_error(const Configuration& configuration, const std::string& without = "") const;
  HeightRadius typical_error(const Configuration& configuration, const std::string& without = "") const;
  const std::vector<ChartRow>& rows() const { return runs; }

private:
  /// Root mean squares by column, in ascending order each.
  std::pair<std::vector<double>, std::vector<double>> column_errors(const Configuration& configuration,
                                                                    const std::string& without) const;
  void find_references();
  ChartPoint point_of(const Configuration& configuration) const;
  double seconds_of(const ChartRow& row) const;
  double cost_over_all(const Configuration& configuration) const;

  std::vector<ChartRow> runs;
  std::map<std::string, double> reference_resolution; ///< by column
  std::map<std::string, bool> in_plane;               ///< by column: its flow
  std::map<std::string, HeightRadius> reference;      ///< by column
  std::map<std::string, double> base_seconds;         ///< by column, of its coarsest default run
  std::map<Configuration, double> rate;               ///< particle-steps per second, by what changes it
  std::vector<ChartPoint> all;
};

/// True for the flow of the plane; all others are of the axisymmetric column.
bool is_plane(const Configuration& configuration);

/// Table of the points, for readers and figures.
void write_points(const std::filesystem::path& file, const ChartData& data);

} // namespace drivers
