// SPDX-License-Identifier: BSD-3-Clause
// The complete state of a run of the sampler, from which it can be continued.
#pragma once
#include "calibration/proposal.hpp"
#include "calibration/sampler.hpp"

namespace calibration {

struct SamplerState {
  std::int64_t step = 0;         ///< steps made, including burn-in and thinned ones
  Eigen::MatrixXd points;        ///< (dimensions, walkers), present points of the walkers
  Eigen::VectorXd log_density;   ///< (walkers)
  Eigen::MatrixXd archive;       ///< (dimensions, points): start and burn-in in order
  ProposalKernel kernel;         ///< fitted to a part of the archive
  std::int64_t fitted_first = 0; ///< first column of that part, and number of its columns
  std::int64_t fitted_count = 0;
  std::vector<unsigned char> random;                               ///< state of the stream
  std::int64_t proposed = 0, accepted = 0;                         ///< in kept and thinned steps
  std::int64_t independent_proposed = 0, independent_accepted = 0; ///< since the kernel was fitted
  Chain chain;
};

} // namespace calibration
