// SPDX-License-Identifier: BSD-3-Clause
// The best parameters by nonlinear least squares (GSL, Levenberg-Marquardt in a trust region) from several starts.
// Bounds by u = middle + half width * sin(y): searches go over y.
#pragma once
#include "calibration/objective.hpp"
#include <functional>
#include <string>

namespace calibration {

/// One search.
struct Search {
  Eigen::VectorXd start, end;      ///< coordinates u of all unknowns
  double start_cost = 0, cost = 0; ///< half the sum of squared residuals
  int iterations = 0;
  bool converged = false;
};

struct BestFit {
  std::vector<Search> searches; ///< best first, at the errors assumed before the last refinement
  Search best;
  Eigen::MatrixXd jacobian; ///< d residual / d u at the best, (residuals, unknowns of the material)
  double chi_squared = 0;   ///< of the curves, effective rows
  double degrees = 0;       ///< effective rows less parameters
};

/// Searches from several starts, then refines the best while errors that depend on the model, correlation of
/// residuals and the model's own error settle (they are set in `objective`). `tell` receives one line of progress.
BestFit least_squares(Objective& objective, const std::function<void(const std::string&)>& tell = {});

/// Points of a Sobol sequence, shifted by a random vector of `seed`, in the box of the unknowns: (unknowns, count).
Eigen::MatrixXd spread_points(const std::vector<FreeParameter>& unknowns, int count, std::uint64_t seed);

} // namespace calibration
