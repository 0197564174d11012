// SPDX-License-Identifier: BSD-3-Clause
// Proposals of the next point of a walker from an archive of earlier points: the moves of calibration/SAMPLER.md.
#pragma once
#include "calibration/mixture.hpp"
#include "calibration/random_stream.hpp"
#include <Eigen/Core>
#include <array>

namespace calibration {

enum class Move { difference, mode_jump, snooker, independent };
constexpr int moves = 4;

/// The data that proposals are drawn from; constant after burn-in.
struct ProposalKernel {
  Eigen::MatrixXd archive; ///< (dimensions, points)
  Eigen::VectorXd spread;  ///< standard deviation of the archive in each dimension
  StudentMixture mixture;
  std::array<double, moves> weight{}; ///< probability of each move, sum 1
};

struct Proposal {
  Move move = Move::difference;
  Eigen::VectorXd point;
  double log_ratio = 0; ///< log of backward over forward proposal density
};

/// Probability of each move; that of the independent move increases with its acceptance.
std::array<double, moves> move_weights(double independent_acceptance);

/// Fits spread and mixture to the archive. Throws std::runtime_error if it lies in a subspace.
ProposalKernel fit_kernel(Eigen::MatrixXd archive, const std::array<double, moves>& weight,
                          RandomStream& random);

Proposal propose(const ProposalKernel& kernel, const Eigen::Ref<const Eigen::VectorXd>& from,
                 RandomStream& random);

} // namespace calibration
