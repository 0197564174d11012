// SPDX-License-Identifier: BSD-3-Clause
// The Bayesian part of a fit: samples of the posterior and their predictions for all curves, those held out included.
#pragma once
#include "calibration/diagnostics.hpp"
#include "calibration/identifiability.hpp"
#include "calibration/sampler.hpp"

namespace calibration {

/// Quantiles of 5, 50 and 95 % over the rows of one curve.
struct Band {
  std::vector<double> model_lower, model_median,
      model_upper;                  ///< of the model's curve, by the parameters alone
  std::vector<double> lower, upper; ///< of a measured value, with the errors of model and measurement
  double coverage = 0;              ///< part of the measured values between lower and upper
};

struct Posterior {
  Chain chain;
  std::vector<std::string> names; ///< of the unknowns
  Eigen::MatrixXd values;         ///< samples as values, not coordinates: (unknowns, samples)
  Diagnosis diagnosis;            ///< of the values
  std::vector<Band> bands;        ///< one for each curve of the objective
  std::size_t incomplete = 0;     ///< samples drawn for the bands in which a test failed; left out
};

struct ChainRun {
  std::string file; ///< chain on disk; empty: none
  bool resume = false;
  ProgressReport progress;
};

/// Samples about the best fit, whose covariance gives the first points. Throws std::runtime_error.
Posterior sample_posterior(const Objective& objective, const BestFit& best,
                           const Identifiability& identifiability, const SamplingOptions& options,
                           const ChainRun& run = {});

/// Bands over all curves.
void predict_bands(const Objective& objective, const SamplingOptions& options, Posterior& posterior);

/// Hash of everything the posterior depends on.
std::string fingerprint(const Objective& objective);

} // namespace calibration
