// SPDX-License-Identifier: BSD-3-Clause
// `simsand run SCENE --posterior FIT.h5 -n 32`: the uncertainty of a collapse that follows from the uncertainty of
// calibrated parameters. Manual: README.md of this folder.
#pragma once
#include "drivers/study/runs.hpp"
#include <cstdint>

namespace calibration {

struct PropagateOptions {
  std::string scene, posterior;      ///< files
  std::vector<std::string> settings; ///< KEY=VALUE that replace keys of the scene
  drivers::StudyOptions study;       ///< its folder receives the results; empty: the scene's
  int sets = 32;                     ///< of parameters, drawn from the posterior
  std::uint64_t seed = 1;
};

/// Runs the scene once for each set of parameters; complete runs are not repeated. The folder receives sets/NNN, sets.csv
/// (parameters, h_f, r_f, time to rest, whether the run failed), bands.csv, outline_bands.csv, height_bands.csv (5, 50,
/// 95 %) and posterior.png. Failed sets are reported and left out of the bands. Throws std::runtime_error if fewer than
/// two runs succeed, and as read_posterior and require_fit_for.
void propagate(PropagateOptions options);

} // namespace calibration
