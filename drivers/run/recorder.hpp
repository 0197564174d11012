// SPDX-License-Identifier: BSD-3-Clause
// Watches a run: samples its time series, writes snapshots to the result file, tells when it is at rest,
// and reads the results off the final state.
#pragma once
#include "host/engine/metrics.hpp"
#include "host/files/checkpoint.hpp"
#include <optional>

namespace drivers {

/// Impulse and work of a wall since the start, and the mean force on it since the sample before.
struct WallSample {
  host::WallLoad load;
  host::WallVector force{}; ///< N
  double normal_force = 0;  ///< N, pressure times area
};

/// One row of the time series; units in `series_columns`.
struct Sample {
  double time = 0, height = 0, front = 0;
  double kinetic = 0, potential = 0;
  host::Work work;
  double internal = 0, inelastic = 0;
  double imbalance = 0; ///< (kinetic + potential - initial potential - work) / energy_scale
  double step_size = 0;
  std::vector<WallSample> walls; ///< one for each of the simulation's walls
};

template <class Geometry> class Recorder {
public:
  explicit Recorder(const host::Simulation<Geometry>& simulation);
  /// Continues the result of an interrupted run. `simulation` is still at its start.
  Recorder(const host::Simulation<Geometry>& simulation, const host::RunProgress& progress);

  /// Samples and writes what is due at the current time.
  void observe(const host::Simulation<Geometry>& simulation);
  /// Writes a sample and a snapshot now, unless the last ones are of this time.
  void write_snapshot(const host::Simulation<Geometry>& simulation);
  /// True once the energy is below the scene's fraction, the height stands still between two samples
  /// and the gate has cleared the column.
  bool at_rest() const { return rest_time.has_value(); }
  /// What a checkpoint must hold of it (all but the time spent); the result on disk is then as far.
  host::RunProgress progress();
  /// Writes the summary and closes the file as complete.
  void finish(const host::Simulation<Geometry>& simulation,
              std::span<const std::pair<host::Quantity, double>> summary);

  const std::vector<Sample>& samples() const { return series; }
  const std::vector<double>& outline() const { return heights; }
  const std::vector<double>& radii() const { return abscissa; }
  std::optional<double> time_to_rest() const { return rest_time; }
  std::string file() const { return result.path().string(); }
  /// Files of snapshots that the continued result has lost.
  const std::vector<std::filesystem::path>& left_out() const { return result.left_out(); }

private:
  void sample(const host::Simulation<Geometry>& simulation);
  void write_constants(const host::Simulation<Geometry>& simulation);

  std::vector<double> abscissa, heights;
  std::vector<Sample> series;
  std::optional<double> rest_time;
  double next_sample = 0, next_snapshot = 0, last_snapshot = -1;
  host::ResultFile result;
};

} // namespace drivers
