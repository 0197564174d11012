// SPDX-License-Identifier: BSD-3-Clause
// `simsand run`: a scene from its file to rest, with progress, results on disk and a closing table.
#pragma once
#include "host/files/output.hpp"
#include "host/scene.hpp"
#include <filesystem>
#include <utility>

namespace drivers {

struct RunOptions {
  bool quiet = false;                 ///< no progress
  std::filesystem::path checkpoint{}; ///< to go on from; empty: from the start
};

/// What a run measured, by name: also the summary of the result file.
using Summary = std::vector<std::pair<host::Quantity, double>>;

/// Runs the scene and prints its table. Throws std::runtime_error; what was computed until then is in
/// the result file. Throws Interrupted if a signal asked to stop (listen_for_signals).
Summary run_scene(const host::Scene& scene, const RunOptions& options);

} // namespace drivers
