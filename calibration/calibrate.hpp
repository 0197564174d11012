// SPDX-License-Identifier: BSD-3-Clause
// The command `simsand calibrate`: manual in README.md.
#pragma once
#include <string>

namespace calibration {

struct CalibrateOptions {
  std::string fit_file;
  std::string folder;     ///< for the results; empty: that of the fit file
  bool resume = false;    ///< continue the chain of an interrupted run
  bool best_only = false; ///< no sampling
  int coverage = 0;       ///< number of synthetic data sets of a coverage study; 0: a fit
  bool quiet = false;     ///< no progress lines
  std::string command;    ///< as typed, for the report
};

/// Fits, samples if the file asks for it, writes and prints the report. Throws std::runtime_error.
void calibrate(const CalibrateOptions& options);

} // namespace calibration
