// SPDX-License-Identifier: BSD-3-Clause
// What is in a result file or a checkpoint, in brief: everything but the particles. A file whose checksum does not fit
// (seal.hpp) counts as unreadable.
#pragma once
#include "host/files/output.hpp"

namespace host {

struct StoredRun {
  bool checkpoint = false; ///< else a result
  bool complete = false;
  std::string scene, version, compiler, geometry;
  double particles = 0;
  double time = 0;                    ///< s, of the state: of the last sample, or of the checkpoint
  double steps = -1;                  ///< negative: unknown, for only checkpoints and complete results say it
  int snapshots = 0;                  ///< that are whole and can be read
  std::vector<double> snapshot_times; ///< s; empty for checkpoints, whose snapshots are in other files
  std::vector<std::pair<Quantity, std::vector<double>>> series;
  std::vector<std::pair<Quantity, double>> summary;
};

/// Throws std::runtime_error, one line that names the file, if it is neither.
StoredRun read_stored_run(const std::filesystem::path& path);

/// The resolved scene in a result file or checkpoint. Throws std::runtime_error naming the file.
std::string stored_scene(const std::filesystem::path& path);

/// Attribute `build` of a result: hashes of the program and of the material library. Empty if it cannot be read.
std::string stored_build(const std::filesystem::path& path);

/// False also if there is no such file or it cannot be read.
bool is_complete_result(const std::filesystem::path& path);

} // namespace host
