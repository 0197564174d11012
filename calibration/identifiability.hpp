// SPDX-License-Identifier: BSD-3-Clause
// What the tests determine: covariance at the best fit, and combinations of parameters that do not change the curves,
// from the singular values of the Jacobian with parameters in units of their ranges.
#pragma once
#include "calibration/least_squares.hpp"

namespace calibration {

/// A direction in the box of the parameters.
struct Combination {
  double singular_value = 0; ///< change of the residuals' norm over the whole range
  double deviation = 0;      ///< standard deviation along it, over the range; 0.29 without any test
  Eigen::VectorXd weights;   ///< of the parameters over their ranges, unit length
  bool determined = true;
};

enum class Finding { determined, weak, undetermined, at_lower_bound, at_upper_bound };

struct Identifiability {
  Eigen::MatrixXd covariance;            ///< of u; the bounds act as a prior of variance range^2 / 12
  Eigen::MatrixXd correlation;           ///< of u
  Eigen::VectorXd deviation;             ///< of u over its range
  std::vector<Combination> combinations; ///< best determined first
  std::vector<Finding> findings;         ///< one for each parameter
  double inflation = 1; ///< factor on the covariance: chi squared over degrees of freedom where above 1
};

/// Standard deviations over the range: above the first a parameter counts as weakly determined, above the second as not
/// determined.
inline constexpr double weak_deviation = 0.05, undetermined_deviation = 0.15;

Identifiability identify(const Objective& objective, const BestFit& fit);

std::string_view describe(Finding finding);

} // namespace calibration
