// SPDX-License-Identifier: BSD-3-Clause
// Everything a run of the sampler needs to go on where it stopped.
#pragma once
#include "calibration/proposal.hpp"
#include "calibration/sampler.hpp"

namespace calibration {

struct SamplerState {
  std::int64_t step = 0;         ///< steps made, burn-in and thinned ones included
  Eigen::MatrixXd points;        ///< (dimensions, walkers), where the walkers are
  Eigen::VectorXd log_density;   ///< (walkers)
  Eigen::MatrixXd archive;       ///< (dimensions, points): start and burn-in in order
  ProposalKernel kernel;         ///< fitted to a part of the archive
  std::int64_t fitted_first = 0; ///< that part: first column and number of columns
  std::int64_t fitted_count = 0;
  std::vector<unsigned char> random;                               ///< state of the stream
  std::int64_t proposed = 0, accepted = 0;                         ///< in kept and thinned steps
  std::int64_t independent_proposed = 0, independent_accepted = 0; ///< since the kernel was fitted
  Chain chain;
};

} // namespace calibration
