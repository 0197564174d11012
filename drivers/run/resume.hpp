// SPDX-License-Identifier: BSD-3-Clause
// Where an interrupted run is, and whether this program may go on with it.
#pragma once
#include "host/files/checkpoint.hpp"
#include <filesystem>
#include <optional>

namespace drivers {

/// The checkpoints of a run, in the folder of its results.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder);
std::filesystem::path previous_checkpoint_path(const std::filesystem::path& folder);

/// A run to go on with: its scene (with the folder it lies in) and its latest readable checkpoint.
struct Resumption {
  host::Scene scene;
  std::filesystem::path checkpoint;
};

/// Finds the run by `what`: the folder of its results, a file in it, or its scene file (which must not have
/// changed, nor `settings`, key=value, which go with a scene file only); `folder`, unless empty, is where a scene file's results are instead of its output.folder. Empty
/// if the run is complete. Throws std::runtime_error, one line, if there is no checkpoint or none that can be
/// read, if it is of another scene or of another version. Warns of a checkpoint that cannot be read while the
/// one before can, of a scene beside the results that cannot be read, of a changed material library and of another compiler.
std::optional<Resumption> find_resumption(const std::string& what, const std::string& folder,
                                          const std::vector<std::string>& settings = {});

/// Header of a checkpoint of `scene`, without time, steps and particles.
host::CheckpointHeader header_of(const host::Scene& scene);

/// After a run has been read from the checkpoint `read`: if that was the one before the newest, the newest is
/// damaged. It is removed, so that it never takes the place of the good one.
void remove_newer_checkpoint(const std::filesystem::path& read);

/// Removes the checkpoints in a folder; true if there were any.
bool remove_checkpoints(const std::filesystem::path& folder);

} // namespace drivers
