// SPDX-License-Identifier: BSD-3-Clause
// A test of the intervals of a fit: many synthetic data sets are made from known parameters, fitted and sampled, and the
// 90 % intervals that contain the true parameter are counted.
#pragma once
#include "calibration/fit_file.hpp"
#include <functional>
#include <string>
#include <vector>

namespace calibration {

/// One parameter of one data set.
struct IntervalCheck {
  double truth = 0, lower = 0, upper = 0, mean = 0, best = 0;
  bool converged = false; ///< the chains of its data set passed their checks
  bool inside() const { return truth >= lower && truth <= upper; }
};

struct Coverage {
  std::vector<std::string> names;
  std::vector<std::vector<IntervalCheck>> sets; ///< data set, parameter; empty: not finished
  /// Part of the intervals that contain the truth: of one parameter, of all.
  double of(std::size_t parameter) const;
  double overall() const;
};

/// Data set k has the seed of `fit.synthetic` + k, k from 1; sets run side by side on all threads. `fit` needs synthetic
/// and sampling options. Sets that are finished in `earlier` are taken from it. `progress` receives the present results
/// and the number of finished sets.
Coverage study_coverage(const Fit& fit, int sets, const Coverage& earlier = {},
                        const std::function<void(const Coverage&, int)>& progress = {});

/// One line per finished data set and parameter.
std::string coverage_csv(const Fit& fit, const Coverage& coverage);
/// Reads what coverage_csv wrote. Throws std::runtime_error if it belongs to another fit.
Coverage read_coverage(const Fit& fit, const std::string& file);
/// The counts as a table for the terminal.
std::string coverage_text(const Coverage& coverage);

} // namespace calibration
