// SPDX-License-Identifier: BSD-3-Clause
// Whether the intervals of a fit hold what they promise: many synthetic data sets are made from known parameters, fitted
// and sampled, and the 90 % intervals that contain the truth are counted.
#pragma once
#include "calibration/fit_file.hpp"
#include <functional>
#include <string>
#include <vector>

namespace calibration {

struct Covered {
  double truth = 0, lower = 0, upper = 0, mean = 0, best = 0;
  bool converged = false; ///< the chains of its set passed their checks
  bool inside() const { return truth >= lower && truth <= upper; }
};

struct Coverage {
  std::vector<std::string> names;
  std::vector<std::vector<Covered>> sets; ///< data set, parameter
  double part(std::size_t parameter) const;
  double overall() const;
};

/// Data set k has the seed of `fit.synthetic` + k, k from 1; sets run side by side on all threads. `fit` needs synthetic
/// and sampling options. Sets that `known` holds are taken from it. `tell` receives the sets finished so far, those
/// that are not are empty, and their number.
Coverage study_coverage(const Fit& fit, int sets, const Coverage& known = {},
                        const std::function<void(const Coverage&, int)>& tell = {});

/// One line per finished data set and parameter.
std::string coverage_csv(const Fit& fit, const Coverage& coverage);
/// What coverage_csv wrote. Throws std::runtime_error if it is of another fit.
Coverage read_coverage(const Fit& fit, const std::string& file);
/// The counts, and whether they lie where 90 % intervals of this many sets should.
std::string coverage_text(const Coverage& coverage);

} // namespace calibration
