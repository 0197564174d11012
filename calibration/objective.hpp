// SPDX-License-Identifier: BSD-3-Clause
// How far simulated curves are from measured ones, and how likely that makes the parameters.
//
// Row i of a curve misses by z_i = (measured - model) / sigma_i, with sigma_i^2 of the measurement and of the model.
// A curve's log likelihood is that of n_eff independent rows, -n_eff sum_i w_i (z_i^2 / 2 + ln sigma_i), with weights w_i
// that share out its arc, sum 1, and n_eff = 1 / sum w_i^2 where rows are independent (Kish 1965), fewer where
// residuals are correlated: README.md, "Residuals".
#pragma once
#include "calibration/fit_file.hpp"
#include "calibration/simulation.hpp"
#include <memory>
#include <mutex>

namespace calibration {

/// One curve with what its rows count.
struct WeighedCurve {
  std::size_t test = 0; ///< position in Fit::tests
  Measure measure = Measure::stress_ratio;
  std::vector<double> measured;
  std::vector<double> share;   ///< of the arc, sum 1
  std::vector<double> error;   ///< standard deviation of the measurement, in the unit of the curve
  double peak = 1;             ///< largest magnitude
  double independent_rows = 1; ///< n_eff
  double weight = 1;           ///< of the test and of the measure
  std::size_t first_row = 0;   ///< in the vector of all residuals
};

/// Residual of rows that a failed simulation does not reach: bad, and finite.
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

  /// Residuals of the fitted curves and of priors: half their sum of squares is minus the log posterior, up to what
  /// depends on the model's error alone. Column j at column j of `points`; on all threads.
  Eigen::MatrixXd residuals(const Eigen::Ref<const Eigen::MatrixXd>& points) const;
  std::size_t residual_count() const;
  /// Log likelihood plus log prior, for each column; on all threads.
  Eigen::VectorXd log_posterior(const Eigen::Ref<const Eigen::MatrixXd>& points) const;

  /// Errors of measurement that belong to these values (those relative to the value are of a smooth curve, not of
  /// the noise).
  void set_errors(const std::vector<std::vector<double>>& values);
  /// Rows that count as independent, from the correlation of neighbouring residuals at u.
  void estimate_correlation(const Eigen::VectorXd& u);
  /// The model's errors in u that the residuals at u ask for; u without free ones.
  Eigen::VectorXd estimate_model_error(Eigen::VectorXd u) const;
  /// Standard deviation of the model's error of a curve at u, in its unit.
  double model_error(const WeighedCurve& curve, const Eigen::VectorXd& u) const;

  /// Simulations so far, and those in which a test failed.
  long simulations() const { return pool->simulations; }
  long failures() const { return pool->failures; }

private:
  struct Pool {
    std::mutex mutex;
    std::vector<std::unique_ptr<Simulator>> idle;
    long simulations = 0, failures = 0;
  };
  template <class Use> void simulated(const Eigen::VectorXd& u, const Use& use) const;
  std::size_t fitted_rows = 0;
  std::vector<Specimen> specimens;
  std::unique_ptr<Pool> pool;
};

} // namespace calibration
