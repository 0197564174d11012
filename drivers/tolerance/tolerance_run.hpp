// SPDX-License-Identifier: BSD-3-Clause
// `simsand run SCENE --tolerance 5%`: the configuration is chosen from the chart's data, the scene is run, then a coarser
// companion, and the error of h_f and r_f is estimated. How it is done and how far it holds: tests/charts/ACCURACY.md.
#pragma once
#include "drivers/run/run.hpp"
#include "drivers/tolerance/choice.hpp"

namespace drivers {

struct ToleranceOptions {
  std::string scene;    ///< file, .toml or .h5
  Words settings;       ///< of the user
  std::string folder;   ///< for the results; empty: the scene's
  double tolerance = 0; ///< relative error of h_f and r_f that is asked for
  std::string data;     ///< the project's data folder
};

/// A share from "5%" or "0.05". Throws std::runtime_error unless it is above 0 and at most a half.
double read_tolerance(const std::string& text);

/// One quantity of the deposit with its interval.
struct Estimate {
  std::string quantity;
  double value = 0, companion = 0; ///< over r0
  double chart_error = 0;          ///< relative, of the configuration
  double half_width = 0;           ///< relative
  double lower() const { return value * (1 - half_width); }
  double upper() const { return value * (1 + half_width); }
};

/// The folder receives, beside the results, scene_for_tolerance.toml (the scene without what was chosen), companion/ and
/// accuracy.csv. A complete result of the same scene and choice is not run again. Throws std::runtime_error: a tolerance
/// that the chart cannot promise, or a scene whose keys conflict with the choice.
std::vector<Estimate> run_to_tolerance(const ToleranceOptions& options, const RunOptions& run);

} // namespace drivers
