// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/proposal.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace calibration {
namespace {

constexpr double jitter =
    1e-3; ///< normal noise added to a difference, in spreads: makes every point reachable
constexpr double subset_moves = 0.2,
                 subset_part = 0.3; ///< part of the differences in a subset; part of dimensions in it
constexpr double short_moves = 0.3,
                 short_factor = 0.2; ///< part of the differences that are shortened, for thin tails
constexpr int most_components = 10;  ///< of the mixture
constexpr int most_fitted = 2000;    ///< points of the archive that the mixture is fitted to

const auto random_point(const ProposalKernel& kernel, RandomStream& random) {
  return kernel.archive.col(random.below(int(kernel.archive.cols())));
}

/// x + g (z1 - z2) + noise, one time in five in a random subset of the dimensions: ter Braak 2006 eq. 2, Vrugt et
/// al. 2009. Symmetric, as subset, factor and pair do not depend on x.
Eigen::VectorXd difference(const ProposalKernel& kernel, const Eigen::VectorXd& from, RandomStream& random) {
  const auto dimensions = from.size();
  const double part = random.uniform() < subset_moves ? subset_part : 1;
  const auto always = random.below(int(dimensions));
  Eigen::VectorXd changed(dimensions), noise(dimensions);
  for (Eigen::Index i = 0; i < dimensions; ++i) {
    changed(i) = i == always || random.uniform() < part;
    noise(i) = jitter * kernel.spread(i) * random.normal();
  }
  const double shorter = random.uniform() < short_moves ? short_factor : 1;
  const double factor = shorter * 2.38 / std::sqrt(2 * changed.sum()) * std::exp(0.3 * random.normal());
  const auto one = random_point(kernel, random), other = random_point(kernel, random);
  return from + changed.cwiseProduct(factor * (one - other) + noise);
}

/// x + z1 - z2 + noise in all dimensions, which may lead from one mode to another: ter Braak 2006 section 2.
Eigen::VectorXd mode_jump(const ProposalKernel& kernel, const Eigen::VectorXd& from, RandomStream& random) {
  Eigen::VectorXd noise(from.size());
  for (Eigen::Index i = 0; i < from.size(); ++i) noise(i) = jitter * kernel.spread(i) * random.normal();
  const auto one = random_point(kernel, random), other = random_point(kernel, random);
  return from + one - other + noise;
}

/// Along the line through x and z by the difference of two points projected on it: ter Braak and Vrugt 2008 eq. 3
/// and the ratio (|x' - z| / |x - z|)^(d - 1) of eq. 4.
Proposal snooker(const ProposalKernel& kernel, const Eigen::VectorXd& from, RandomStream& random) {
  const double factor = 1.2 + random.uniform();
  const auto z = random_point(kernel, random), one = random_point(kernel, random),
             other = random_point(kernel, random);
  const Eigen::VectorXd line = from - z;
  const double before = line.norm();
  if (before == 0) return {Move::snooker, from, -std::numeric_limits<double>::infinity()};
  Proposal p{Move::snooker, from + factor * (one - other).dot(line) / (before * before) * line, 0};
  p.log_ratio = double(from.size() - 1) * std::log((p.point - z).norm() / before);
  return p;
}

Proposal independent(const ProposalKernel& kernel, const Eigen::VectorXd& from, RandomStream& random) {
  Proposal p{Move::independent, kernel.mixture.draw(random), 0};
  p.log_ratio = kernel.mixture.log_density(from) - kernel.mixture.log_density(p.point);
  return p;
}

/// At most `most_fitted` columns, evenly spaced.
Eigen::MatrixXd thinned(const Eigen::MatrixXd& archive) {
  const Eigen::Index kept = std::min<Eigen::Index>(archive.cols(), most_fitted);
  Eigen::MatrixXd columns(archive.rows(), kept);
  for (Eigen::Index k = 0; k < kept; ++k) columns.col(k) = archive.col(k * archive.cols() / kept);
  return columns;
}

} // namespace

std::array<double, moves> move_weights(double independent_acceptance) {
  const double independent = 0.1 + 0.4 * std::min(1.0, independent_acceptance / 0.3);
  const double rest = 1 - independent;
  return {0.75 * rest, 0.1 * rest, 0.15 * rest, independent};
}

ProposalKernel fit_kernel(Eigen::MatrixXd archive, const std::array<double, moves>& weight,
                          RandomStream& random) {
  ProposalKernel kernel;
  const Eigen::VectorXd mean = archive.rowwise().mean();
  kernel.spread = ((archive.colwise() - mean).array().square().rowwise().mean()).sqrt();
  kernel.mixture = fit_mixture(thinned(archive), most_components, random);
  kernel.archive = std::move(archive);
  kernel.weight = weight;
  return kernel;
}

Proposal propose(const ProposalKernel& kernel, const Eigen::Ref<const Eigen::VectorXd>& from,
                 RandomStream& random) {
  double left = random.uniform();
  int move = 0;
  while (move + 1 < moves && (left -= kernel.weight[move]) > 0) ++move;
  switch (Move(move)) {
  case Move::difference:
    return {Move::difference, difference(kernel, from, random), 0};
  case Move::mode_jump:
    return {Move::mode_jump, mode_jump(kernel, from, random), 0};
  case Move::snooker:
    return snooker(kernel, from, random);
  case Move::independent:
    break;
  }
  return independent(kernel, from, random);
}

} // namespace calibration
