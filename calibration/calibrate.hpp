// SPDX-License-Identifier: BSD-3-Clause
// The command `simsand calibrate`: manual in README.md.
#pragma once
#include <string>

namespace calibration {

struct CalibrateOptions {
  std::string fit_file;
  std::string folder;     ///< for the results, instead of that of the file
  bool resume = false;    ///< go on with the chain of an interrupted run
  bool best_only = false; ///< no sampling
  int coverage = 0;       ///< synthetic data sets for a study of coverage; 0: a fit
  bool quiet = false;     ///< no progress
  std::string command;    ///< as typed, for the report
};

/// Fits, samples if the file asks for it, writes and prints the report. Throws std::runtime_error.
void calibrate(const CalibrateOptions& options);

} // namespace calibration
