// SPDX-License-Identifier: BSD-3-Clause
// Residuals between simulated and measured curves, and the posterior density that follows from them.
//
// The residual of row i is z_i = (measured - model) / sigma_i, where sigma_i^2 is the variance of the measurement plus
// that of the model. A curve's log likelihood is that of n_eff independent rows, -n_eff sum_i w_i (z_i^2 / 2 + ln sigma_i).
// The weights w_i, sum 1, are the parts of the curve's arc length next to row i. n_eff = 1 / sum w_i^2 where rows are
// independent (Kish 1965), less where residuals are correlated: README.md, "Residuals".
#pragma once
#include "calibration/fit_file.hpp"
#include "calibration/simulation.hpp"
#include <memory>
#include <mutex>

namespace calibration {

/// One measured curve with errors and weights of its rows.
struct WeighedCurve {
  std::size_t test = 0; ///< position in Fit::tests
  Measure measure = Measure::stress_ratio;
  std::vector<double> measured;
  std::vector<double> share;   ///< w_i: part of the arc length that belongs to each row, sum 1
  std::vector<double> error;   ///< standard deviation of the measurement, in the unit of the curve
  double peak = 1;             ///< largest magnitude of the values
  double independent_rows = 1; ///< n_eff
  double weight = 1;           ///< that of the test times that of the measure
  std::size_t first_row = 0;   ///< in the vector of all residuals
};

/// Residual of rows that a failed simulation does not reach: large, but finite, so that a search can go on.
inline constexpr double failed_residual = 100;

class Objective {
public:
  explicit Objective(const Fit& fit);

  const Fit& fit;
  std::vector<WeighedCurve> curves; ///< of tests that are fitted, then of those held out
  std::size_t fitted_curves = 0;

  /// PROPS at coordinates u, one for each unknown.
  std::vector<double> properties(const Eigen::VectorXd& u) const;
  /// Model values of all curves at u; NaN where the path ends early.
  std::vector<std::vector<double>> predict(const Eigen::VectorXd& u) const;

  /// Residuals of the fitted curves and of normal priors: half their sum of squares is minus the log posterior, but for
  /// terms that depend on the model's error alone. Column j belongs to column j of `points`. Uses all threads.
  Eigen::MatrixXd residuals(const Eigen::Ref<const Eigen::MatrixXd>& points) const;
  std::size_t residual_count() const;
  /// Log likelihood plus log prior of each column. Uses all threads.
  Eigen::VectorXd log_posterior(const Eigen::Ref<const Eigen::MatrixXd>& points) const;

  /// Computes the errors of measurement from these values of the curves: an error relative to the value must not
  /// follow the noise of the data.
  void set_errors(const std::vector<std::vector<double>>& values);
  /// Sets the number of independent rows from the correlation of neighbouring residuals at u.
  void estimate_correlation(const Eigen::VectorXd& u);
  /// u with those model errors that are unknowns replaced by what the residuals at u beyond the measurement error imply.
  Eigen::VectorXd estimate_model_error(Eigen::VectorXd u) const;
  /// Standard deviation of the model's error of a curve at u, in its unit.
  double model_error(const WeighedCurve& curve, const Eigen::VectorXd& u) const;

  /// Simulations of all tests so far, and those in which a test failed.
  long simulations() const { return pool->simulations; }
  long failures() const { return pool->failures; }

private:
  /// Simulators that no thread uses at the moment.
  struct Pool {
    std::mutex mutex;
    std::vector<std::unique_ptr<Simulator>> idle;
    long simulations = 0, failures = 0;
  };
  /// Calls use(paths) with the paths of all tests at u.
  template <class Use> void with_paths(const Eigen::VectorXd& u, const Use& use) const;
  std::size_t fitted_rows = 0;
  std::vector<Specimen> specimens;
  std::unique_ptr<Pool> pool;
};

} // namespace calibration
