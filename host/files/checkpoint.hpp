// SPDX-License-Identifier: BSD-3-Clause
// A run between two steps, on disk: particles, neighbour lists, time, work, and how far its results have
// come. A run that goes on from it makes the same numbers, to the last bit, as one that never stopped; so
// the neighbour lists are stored, for their age and order are in the sums.
#pragma once
#include "host/engine/simulation.hpp"
#include "host/files/output.hpp"

namespace host {

/// What a checkpoint belongs to: read before anything is built from it.
struct CheckpointHeader {
  std::string scene;    ///< resolved, TOML
  std::string version;  ///< of the program
  std::string compiler; ///< compiler and its flags
  std::string geometry;
  std::string library, library_hash; ///< the material's, path and content
  double time = 0;                   ///< s, simulated
  double steps = 0;
  double particles = 0;
};

/// Time that a run has taken, s: of the clock on the wall and of all processors.
struct Spent {
  double wall = 0, processor = 0;
};

/// What a run remembers beside the simulation.
struct RunProgress {
  ResultProgress result;
  double next_sample = 0, next_snapshot = 0, last_snapshot = -1; ///< s, simulated
  double rest_time = -1;                                         ///< s; negative: not at rest
  Spent spent;                                                   ///< by all parts of the run
};

/// The bytes of a checkpoint, with a checksum over all of them (seal.hpp).
template <class Geometry>
std::string checkpoint_image(const CheckpointHeader& header, Simulation<Geometry>& simulation,
                             const RunProgress& progress);

/// Replaces `path` as a whole; the file that was there goes on as `previous`. Throws std::runtime_error that
/// names the file; both old files are then as they were.
template <class Geometry>
void write_checkpoint(const std::filesystem::path& path, const std::filesystem::path& previous,
                      const CheckpointHeader& header, Simulation<Geometry>& simulation,
                      const RunProgress& progress);

/// Header of a checkpoint whose checksum fits. Throws std::runtime_error, one line, if the file is missing,
/// cut short, damaged or no checkpoint.
CheckpointHeader verified_checkpoint(const std::filesystem::path& path);
/// The part of it that is no particles. Errors the same.
RunProgress read_run_progress(const std::filesystem::path& path);

/// Brings `simulation`, just started from the stored scene, to the stored state. Throws std::runtime_error
/// that names the file if any part of it is damaged or does not fit.
template <class Geometry>
RunProgress read_checkpoint(const std::filesystem::path& path, Simulation<Geometry>& simulation);

} // namespace host
