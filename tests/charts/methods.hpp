// SPDX-License-Identifier: BSD-3-Clause
// The integrators side by side: each updates the points of a batch by one increment and tells what processor time
// that took.
#pragma once
#include "tests/charts/integrators.hpp"
#include <functional>
#include <string>

namespace charts {

/// Points of one material and their strain increments.
struct Batch {
  const Material* material;
  std::vector<double> props;
  std::vector<Point> old;
  std::vector<Tensor> strain;
};

/// A method and one setting of it.
struct Method {
  std::string name, setting; ///< names in tables
  double yield_tolerance;    ///< f / p beyond which its answer counts as drifted
  /// Fills `answers`, returns seconds of processor time.
  std::function<double(const Batch&, std::vector<Answer>& answers)> update;
};

/// All methods: each in 1, 2, 4, ... equal parts of the increment, that of Sloan with a row of tolerances. The product
/// as one point alone, and as its two shared libraries in blocks of 128. Throws std::runtime_error if a library cannot
/// be loaded.
std::vector<Method> all_methods();

/// One method in `parts` equal parts: a name of all_methods(), with "parts=N" or "tolerance=X" as its setting.
const Method& method_named(const std::vector<Method>& methods, const std::string& name,
                           const std::string& setting);

/// Processor time of this thread, s.
double thread_seconds();

} // namespace charts
