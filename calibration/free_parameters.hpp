// SPDX-License-Identifier: BSD-3-Clause
// The unknowns of a fit: parameters of the material and, where declared free, the size of the model's error. The fit
// works on a coordinate u of each: its value, or the logarithm of it.
#pragma once
#include "calibration/lab_test.hpp"
#include "drivers/files/toml_table.hpp"
#include <Eigen/Core>
#include <optional>

namespace calibration {

/// Prior density of an unknown, over its value, not over u.
struct Prior {
  enum class Kind { uniform, log_uniform, normal, lognormal } kind = Kind::uniform;
  double centre = 0, deviation = 1; ///< normal: mean, standard deviation; lognormal: median, deviation of ln
};

struct FreeParameter {
  std::string name;
  int property = -1;                       ///< position in PROPS; -1: error of the model
  Measure measure = Measure::stress_ratio; ///< of an error of the model
  double lower = 0, upper = 1;             ///< hard bounds of the value
  bool logarithmic = false;                ///< u = ln value
  Prior prior;
  std::optional<double> start; ///< value in the first start

  double coordinate(double value) const;
  double value(double coordinate) const;
  double lowest() const { return coordinate(lower); }
  double highest() const { return coordinate(upper); }
  /// Log density of the prior at u, over u, up to a constant; minus infinity outside the bounds.
  double log_prior(double u) const;
  /// Residual whose half square is minus the log density, for normal and lognormal priors; otherwise 0.
  double prior_residual(double u) const;
  bool has_prior_residual() const;
};

/// Reads `[parameter.NAME]` tables; bounds are within those of the material.
std::vector<FreeParameter> read_parameters(const drivers::TomlTable& table);

} // namespace calibration
