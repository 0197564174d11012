// SPDX-License-Identifier: BSD-3-Clause
// The unknowns of a fit: parameters of the material and, where wanted, the size of the model's error. Everywhere in
// the fit an unknown is a coordinate u: its value, or the logarithm of it.
#pragma once
#include "calibration/lab_test.hpp"
#include "drivers/files/toml_table.hpp"
#include <Eigen/Core>
#include <optional>

namespace calibration {

/// What is known of an unknown before the tests. Densities are over the value, not over u.
struct Prior {
  enum class Kind { uniform, log_uniform, normal, lognormal } kind = Kind::uniform;
  double centre = 0, deviation = 1; ///< normal: mean, standard deviation; lognormal: median, deviation of ln
};

struct FreeParameter {
  std::string name;
  int property = -1;                       ///< position in PROPS; -1: error of the model
  Measure measure = Measure::stress_ratio; ///< whose model error it is
  double lower = 0, upper = 1;             ///< of the value; never left
  bool logarithmic = false;                ///< u = ln value
  Prior prior;
  std::optional<double> start; ///< of the first start

  double coordinate(double value) const;
  double value(double coordinate) const;
  double lowest() const { return coordinate(lower); }
  double highest() const { return coordinate(upper); }
  /// Log density of the prior at u, over u, up to a constant; minus infinity outside the bounds.
  double log_prior(double u) const;
  /// Residual whose half square is minus that log density, where the prior is normal in u; else 0.
  double prior_residual(double u) const;
  bool has_prior_residual() const;
};

/// Reads `[parameter.NAME]` tables; bounds are within those of the material.
std::vector<FreeParameter> read_parameters(const drivers::TomlTable& table);

} // namespace calibration
