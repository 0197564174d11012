// SPDX-License-Identifier: BSD-3-Clause
// The best parameters by nonlinear least squares (GSL, Levenberg-Marquardt in a trust region) from several starts.
// The searched variable is y in u = middle + half width * sin(y), which keeps u within its bounds.
#pragma once
#include "calibration/objective.hpp"
#include <functional>
#include <string>

namespace calibration {

struct LeastSquaresSearch {
  Eigen::VectorXd start, end;      ///< coordinates u of all unknowns
  double start_cost = 0, cost = 0; ///< half the sum of squared residuals
  int iterations = 0;
  bool converged = false;
};

struct BestFit {
  std::vector<LeastSquaresSearch> searches; ///< best first, at the errors assumed before the last refinement
  LeastSquaresSearch best;
  Eigen::MatrixXd jacobian; ///< d residual / d u at the best, (residuals, unknowns of the material)
  double chi_squared = 0;   ///< of the curves, with their effective numbers of rows
  double degrees = 0;       ///< of freedom: effective rows less parameters
};

/// Searches from several starts. Then searches on from the best and updates, in `objective`, errors that depend on the
/// model's values, the correlation of residuals and the model's error. `progress` receives lines of text.
BestFit least_squares(Objective& objective, const std::function<void(const std::string&)>& progress = {});

/// Points of a Sobol sequence, shifted by a random vector of `seed`, in the box of the unknowns: (unknowns, count).
Eigen::MatrixXd spread_points(const std::vector<FreeParameter>& unknowns, int count, std::uint64_t seed);

} // namespace calibration
