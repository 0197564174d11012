// SPDX-License-Identifier: BSD-3-Clause
// `simsand run SCENE --posterior FIT.h5 -n 32`: what the uncertainty of calibrated parameters does to a collapse. Manual:
// README.md of this folder.
#pragma once
#include "drivers/study/runs.hpp"
#include <cstdint>

namespace calibration {

struct PropagateOptions {
  std::string scene, posterior;      ///< files
  std::vector<std::string> settings; ///< of the user
  drivers::StudyOptions study;       ///< folder: for the results; empty: the scene's
  int sets = 32;
  std::uint64_t seed = 1;
};

/// Runs the scene once for each of the sets drawn, complete runs are not run again. The folder receives sets/NNN,
/// sets.csv (parameters, h_f, r_f, time to rest, whether the run failed), bands.csv, outline_bands.csv,
/// height_bands.csv (5, 50, 95 %) and posterior.png. Failed sets are named, and are not in the bands. Throws
/// std::runtime_error if fewer than two runs succeed; errors of read_posterior and require_fit_for.
void propagate(PropagateOptions options);

} // namespace calibration
