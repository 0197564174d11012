// SPDX-License-Identifier: BSD-3-Clause
// The chain on disk: one HDF5 file that holds the kept samples and all a run needs to go on. Layout:
// calibration/SAMPLER.md. A new state is written aside, brought to disk and renamed, so that the file is at any
// moment one complete state, the last or the one before.
#pragma once
#include "calibration/sampler_state.hpp"
#include <filesystem>
#include <string>

namespace calibration {

/// Holds a lock beside the file as long as it lives. All functions throw std::runtime_error with one line that
/// names the file.
class ChainFile {
public:
  /// Creates missing folders. Throws if another run holds the lock, or if the file exists and must not.
  ChainFile(Checkpoint checkpoint, SamplerOptions options);
  ~ChainFile();
  ChainFile(const ChainFile&) = delete;
  ChainFile& operator=(const ChainFile&) = delete;

  bool exists() const;
  /// Throws if the file is damaged, foreign or of another problem or other options; it is left as it is.
  SamplerState read(int dimensions) const;
  void write(const SamplerState& state) const;

private:
  Checkpoint checkpoint;
  SamplerOptions options;
  std::filesystem::path lock_path;
  int lock = -1;
};

/// What a report or a figure needs of a file.
struct StoredChain {
  Chain chain;
  std::vector<std::string> names;
  std::string fingerprint;
};
StoredChain read_chain(const std::filesystem::path& file);

} // namespace calibration
