// SPDX-License-Identifier: BSD-3-Clause
// Convergence of chains and Monte Carlo errors of their results: Vehtari, Gelman, Simpson, Carpenter and Buerkner,
// Bayesian Analysis 16 (2021) 667-718, here [V]. Every function takes draws of one quantity as (steps, chains), at least
// 8 steps; a column is one chain.
#pragma once
#include "calibration/sampler.hpp"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace calibration {

/// Rank-normalised split R-hat, the larger of bulk and folded, [V] eq. 4 and section 4.1. NaN for constant draws.
double split_rhat(const Eigen::MatrixXd& draws);

/// Effective sample size of the mean by Geyer's initial monotone sequence over split chains, [V] eq. 10.
/// NaN for constant draws.
double effective_size(const Eigen::MatrixXd& draws);
/// The same of rank-normalised draws: of the centre of the distribution.
double bulk_effective_size(const Eigen::MatrixXd& draws);
/// The smaller of those of the 5 % and 95 % quantiles: of the intervals.
double tail_effective_size(const Eigen::MatrixXd& draws);

/// Monte Carlo standard errors of the mean and of a quantile, [V] section 4.4.
double error_of_mean(const Eigen::MatrixXd& draws);
double error_of_quantile(const Eigen::MatrixXd& draws, double probability);

struct Interval {
  double lower = 0, upper = 0;
};

/// Quantile by linear interpolation of the order statistics (type 7 of Hyndman and Fan 1996).
double quantile(const Eigen::MatrixXd& draws, double probability);
Interval equal_tailed_interval(const Eigen::MatrixXd& draws, double probability);
/// The shortest interval that holds the given part of the draws; one interval even if there are several modes.
Interval shortest_interval(const Eigen::MatrixXd& draws, double probability);

/// Summary of one dimension.
struct Marginal {
  double mean = 0, deviation = 0, median = 0;
  Interval equal_tailed, shortest; ///< of 90 %
  double rhat = 0, bulk_size = 0, tail_size = 0;
  double mean_error = 0;                   ///< Monte Carlo standard error of the mean
  double lower_error = 0, upper_error = 0; ///< of the ends of the equal-tailed interval
};

/// Limits within which results may be reported. [V] section 6: R-hat below 1.01, 400 effective draws.
struct Thresholds {
  double rhat = 1.01;
  double effective_size = 400; ///< of bulk and of tail
  double acceptance = 0.01;    ///< part of the proposals accepted
  int steps = 100;             ///< of every walker: split chains of 50
};

struct Verdict {
  bool converged = false;
  std::vector<std::string> reasons; ///< why not, one line each, with the number and its threshold
};

struct Diagnosis {
  std::vector<Marginal> marginals; ///< one for each dimension
  Eigen::MatrixXd correlation;     ///< of the samples; NaN in rows of constant dimensions
  double acceptance = 0;
  double slowest_walker = 0; ///< smallest part of the kept steps in which a walker moved
  Verdict verdict;
};

Marginal marginal(const Eigen::MatrixXd& draws);
/// The reasons of the verdict use the `names` of the dimensions.
Diagnosis diagnose(const Chain& chain, const std::vector<std::string>& names,
                   const Thresholds& thresholds = {});

} // namespace calibration
