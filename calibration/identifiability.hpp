// SPDX-License-Identifier: BSD-3-Clause
// What the tests determine: covariance at the best fit, and the combinations of parameters that the curves do not
// see, from the singular values of the Jacobian over parameters in units of their ranges.
#pragma once
#include "calibration/least_squares.hpp"

namespace calibration {

/// A direction in the box of the parameters.
struct Combination {
  double singular_value = 0; ///< change of the residuals' norm over the whole range
  double deviation = 0;      ///< standard deviation along it, over the range; the range's own is 0.29
  Eigen::VectorXd weights;   ///< of the parameters over their ranges, unit length
  bool determined = true;
};

enum class Finding { determined, weak, undetermined, at_lower_bound, at_upper_bound };

struct Identifiability {
  Eigen::MatrixXd covariance;  ///< of u; the bounds count as knowledge of the same variance, range^2 / 12
  Eigen::MatrixXd correlation; ///< of u
  Eigen::VectorXd deviation;   ///< of u over its range
  std::vector<Combination> combinations; ///< best determined first
  std::vector<Finding> findings;         ///< one for each parameter
  double inflation = 1; ///< factor on the covariance: chi squared over degrees of freedom where above 1
};

/// Standard deviations over the range: above the first a parameter is weakly determined, above the second not at
/// all (without any test it is 0.29).
inline constexpr double weak_deviation = 0.05, undetermined_deviation = 0.15;

Identifiability identify(const Objective& objective, const BestFit& fit);

std::string_view in_words(Finding finding);

} // namespace calibration
