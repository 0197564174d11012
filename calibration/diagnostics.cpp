// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/diagnostics.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace calibration {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sorted(const Eigen::MatrixXd& draws) {
  std::vector<double> values(draws.data(), draws.data() + draws.size());
  std::sort(values.begin(), values.end());
  return values;
}

bool constant(const Eigen::MatrixXd& draws) {
  return draws.maxCoeff() == draws.minCoeff();
}

double variance(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return (values.array() - values.mean()).square().sum() / double(values.size() - 1);
}

/// First and second half of every chain as separate chains; of an odd number of steps the middle one is left out.
Eigen::MatrixXd split(const Eigen::MatrixXd& draws) {
  const Eigen::Index half = draws.rows() / 2;
  Eigen::MatrixXd halves(half, 2 * draws.cols());
  halves << draws.topRows(half), draws.bottomRows(half);
  return halves;
}

/// Normal scores of the ranks among all draws; equal draws have their mean rank, [V] eq. 14.
Eigen::MatrixXd rank_normalised(const Eigen::MatrixXd& draws) {
  const Eigen::Index n = draws.size();
  std::vector<Eigen::Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return draws.data()[a] < draws.data()[b]; });
  Eigen::MatrixXd scores(draws.rows(), draws.cols());
  for (Eigen::Index first = 0, last = 0; first < n; first = last) {
    while (last < n && draws.data()[order[last]] == draws.data()[order[first]]) ++last;
    const double rank = 0.5 * double(first + 1 + last);
    const double score = gsl_cdf_ugaussian_Pinv((rank - 0.375) / (double(n) + 0.25));
    for (auto i = first; i < last; ++i) scores.data()[order[i]] = score;
  }
  return scores;
}

/// Gelman and Rubin's ratio for chains that are split already, [V] eqs 1 to 4.
double rhat(const Eigen::MatrixXd& chains) {
  const double n = double(chains.rows());
  double within = 0;
  for (const auto& chain : chains.colwise()) within += variance(chain) / double(chains.cols());
  const double between = n * variance(chains.colwise().mean().transpose());
  return std::sqrt((n - 1) / n + between / within / n);
}

/// Autocovariance of one chain at lags 0 to n - 1, divided by n, by Fourier transform.
Eigen::VectorXd autocovariance(const Eigen::Ref<const Eigen::VectorXd>& chain) {
  const Eigen::Index n = chain.size();
  std::size_t padded = 1;
  while (padded < std::size_t(2 * n)) padded *= 2;
  Eigen::VectorXd work = Eigen::VectorXd::Zero(Eigen::Index(padded));
  work.head(n) = chain.array() - chain.mean();
  gsl_fft_real_radix2_transform(work.data(), 1, padded);
  const Eigen::Index half = Eigen::Index(padded) / 2;
  work(0) *= work(0);
  work(half) *= work(half);
  for (Eigen::Index k = 1; k < half; ++k) { // real part at k, imaginary part at padded - k
    double& imaginary = work(Eigen::Index(padded) - k);
    work(k) = work(k) * work(k) + imaginary * imaginary;
    imaginary = 0;
  }
  gsl_fft_halfcomplex_radix2_inverse(work.data(), 1, padded);
  return work.head(n) / double(n);
}

/// Effective size from the autocorrelations, summed by Geyer's initial monotone sequence, [V] eqs 11 to 13, for chains
/// that are split already.
double effective_size_of_split(const Eigen::MatrixXd& chains) {
  if (constant(chains)) return not_a_number;
  const Eigen::Index n = chains.rows();
  Eigen::VectorXd covariance = Eigen::VectorXd::Zero(n);
  for (const auto& chain : chains.colwise()) covariance += autocovariance(chain) / double(chains.cols());
  const double within = covariance(0) * double(n) / double(n - 1);
  const double total = covariance(0) + variance(chains.colwise().mean().transpose());
  const auto correlation = [&](Eigen::Index lag) { return 1 - (within - covariance(lag)) / total; };
  double pair = 1 + correlation(1), sum = 0;
  Eigen::Index lag = 0;
  for (double smallest = pair; lag + 3 < n && pair > 0;) {
    smallest = std::min(smallest, pair);
    sum += smallest;
    lag += 2;
    pair = correlation(lag) + correlation(lag + 1);
  }
  // Adding the even term of the first pair left out halves the bias of the truncation.
  const double time = -1 + 2 * sum + std::max(correlation(lag), 0.0);
  const double draws = double(chains.size());
  return draws / std::max(time, 1 / std::log10(draws)); // antithetic chains: at most n log10 n
}

/// Quantile of the beta distribution of `size` draws of which the part `probability` lies below: by bisection, as
/// gsl_cdf_beta_Pinv fails for some arguments; by the normal distribution where the two agree to 0.1 %.
double quantile_of_level(double level, double probability, double size) {
  const double rare = std::min(probability, 1 - probability);
  if (size * rare > 2000)
    return probability + gsl_cdf_ugaussian_Pinv(level) * std::sqrt(probability * (1 - probability) / size);
  double below = 0, above = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (below + above) / 2;
    const bool low = gsl_cdf_beta_P(middle, size * probability + 1, size * (1 - probability) + 1) < level;
    (low ? below : above) = middle;
  }
  return (below + above) / 2;
}

Eigen::MatrixXd at_most(const Eigen::MatrixXd& draws, double limit) {
  return (draws.array() <= limit).cast<double>();
}

} // namespace

double split_rhat(const Eigen::MatrixXd& draws) {
  const Eigen::MatrixXd halves = split(draws);
  if (constant(halves)) return not_a_number;
  const double median = quantile(halves, 0.5);
  const Eigen::MatrixXd folded = (halves.array() - median).abs();
  return std::max(rhat(rank_normalised(halves)), rhat(rank_normalised(folded)));
}

double effective_size(const Eigen::MatrixXd& draws) {
  return effective_size_of_split(split(draws));
}

double bulk_effective_size(const Eigen::MatrixXd& draws) {
  return effective_size_of_split(rank_normalised(split(draws)));
}

double tail_effective_size(const Eigen::MatrixXd& draws) {
  const double lower = effective_size(at_most(draws, quantile(draws, 0.05)));
  const double upper = effective_size(at_most(draws, quantile(draws, 0.95)));
  return std::isnan(lower) || std::isnan(upper) ? not_a_number : std::min(lower, upper);
}

double error_of_mean(const Eigen::MatrixXd& draws) {
  return std::sqrt(variance(draws.reshaped()) / effective_size(draws));
}

double error_of_quantile(const Eigen::MatrixXd& draws, double probability) {
  const double size = effective_size(at_most(draws, quantile(draws, probability)));
  if (std::isnan(size)) return not_a_number;
  const auto values = sorted(draws);
  const double count = double(values.size());
  const double one_sigma = gsl_cdf_ugaussian_P(1);
  const auto rank = [&](double level) { return count * quantile_of_level(level, probability, size); };
  const double lower = std::max(std::floor(rank(1 - one_sigma)), 1.0);
  const double upper = std::min(std::ceil(rank(one_sigma)), count);
  return (values[std::size_t(upper) - 1] - values[std::size_t(lower) - 1]) / 2;
}

double quantile(const Eigen::MatrixXd& draws, double probability) {
  const auto values = sorted(draws);
  const double place = probability * double(values.size() - 1);
  const auto below = std::min(std::size_t(place), values.size() - 1),
             above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - double(below)) * (values[above] - values[below]);
}

Interval equal_tailed_interval(const Eigen::MatrixXd& draws, double probability) {
  return {quantile(draws, (1 - probability) / 2), quantile(draws, (1 + probability) / 2)};
}

Interval shortest_interval(const Eigen::MatrixXd& draws, double probability) {
  const auto values = sorted(draws);
  const auto held =
      std::clamp<std::size_t>(std::size_t(std::ceil(probability * double(values.size()))), 1, values.size());
  std::size_t best = 0;
  for (std::size_t first = 0; first + held <= values.size(); ++first)
    if (values[first + held - 1] - values[first] < values[best + held - 1] - values[best]) best = first;
  return {values[best], values[best + held - 1]};
}

Marginal marginal(const Eigen::MatrixXd& draws) {
  if (draws.rows() < 8 || draws.cols() < 1)
    throw std::invalid_argument("diagnostics need chains of at least 8 steps");
  Marginal m;
  m.mean = draws.mean();
  m.deviation = std::sqrt(variance(draws.reshaped()));
  m.median = quantile(draws, 0.5);
  m.equal_tailed = equal_tailed_interval(draws, 0.9);
  m.shortest = shortest_interval(draws, 0.9);
  m.rhat = split_rhat(draws);
  m.bulk_size = bulk_effective_size(draws);
  m.tail_size = tail_effective_size(draws);
  m.mean_error = error_of_mean(draws);
  m.lower_error = error_of_quantile(draws, 0.05);
  m.upper_error = error_of_quantile(draws, 0.95);
  return m;
}

namespace {

Eigen::MatrixXd correlation_matrix(const Chain& chain) {
  const auto all = chain.pooled();
  const Eigen::VectorXd mean = all.rowwise().mean();
  const Eigen::MatrixXd centred = all.colwise() - mean;
  const Eigen::MatrixXd covariance = centred.lazyProduct(centred.transpose());
  Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt();
  for (int i = 0; i < chain.dimensions; ++i)
    if (all.row(i).maxCoeff() == all.row(i).minCoeff()) scale(i) = not_a_number;
  return covariance.array() / (scale * scale.transpose()).array();
}

/// Smallest part of the steps in which a walker moved.
double slowest_walker(const Chain& chain) {
  const auto all = chain.pooled();
  double slowest = 1;
  for (int w = 0; w < chain.walkers; ++w) {
    int moved = 0;
    for (int s = 1; s < chain.steps; ++s)
      moved +=
          all.col(Eigen::Index(s) * chain.walkers + w) != all.col(Eigen::Index(s - 1) * chain.walkers + w);
    slowest = std::min(slowest, moved / std::max(1.0, chain.steps - 1.0));
  }
  return slowest;
}

void check_thresholds(Diagnosis& d, const Chain& chain, const std::vector<std::string>& names,
                      const Thresholds& t) {
  auto& reasons = d.verdict.reasons;
  if (chain.steps < t.steps)
    reasons.push_back(fmt::format("{} kept steps of each walker, {} needed", chain.steps, t.steps));
  if (!(d.acceptance >= t.acceptance))
    reasons.push_back(fmt::format("acceptance {:.4f}, at least {:.4f} needed", d.acceptance, t.acceptance));
  if (chain.steps > 1 && d.slowest_walker == 0) reasons.push_back("a walker never moved");
  for (std::size_t i = 0; i < d.marginals.size(); ++i) {
    const auto& m = d.marginals[i];
    const std::string name = i < names.size() ? names[i] : fmt::format("dimension {}", i);
    if (std::isnan(m.rhat)) {
      reasons.push_back(fmt::format("{}: all samples are equal", name));
      continue;
    }
    if (!(m.rhat < t.rhat))
      reasons.push_back(fmt::format("{}: R-hat {:.3f}, below {} needed", name, m.rhat, t.rhat));
    if (!(m.bulk_size >= t.effective_size))
      reasons.push_back(fmt::format("{}: {:.0f} effective samples of the centre, {:.0f} needed", name,
                                    m.bulk_size, t.effective_size));
    if (!(m.tail_size >= t.effective_size))
      reasons.push_back(fmt::format("{}: {:.0f} effective samples of the tails, {:.0f} needed", name,
                                    m.tail_size, t.effective_size));
  }
  d.verdict.converged = reasons.empty();
}

} // namespace

Diagnosis diagnose(const Chain& chain, const std::vector<std::string>& names, const Thresholds& thresholds) {
  Diagnosis d;
  d.acceptance = chain.acceptance;
  if (chain.steps < 8) {
    d.verdict.reasons.push_back(
        fmt::format("{} kept steps of each walker, {} needed", chain.steps, thresholds.steps));
    return d;
  }
  for (int i = 0; i < chain.dimensions; ++i) d.marginals.push_back(marginal(chain.of(i)));
  d.correlation = correlation_matrix(chain);
  d.slowest_walker = slowest_walker(chain);
  check_thresholds(d, chain, names, thresholds);
  return d;
}

} // namespace calibration
