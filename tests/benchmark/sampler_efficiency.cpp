// SPDX-License-Identifier: BSD-3-Clause
// Effective samples per 1000 evaluations of the density, burn-in included, of the sampler and of published
// ensemble methods, each on the same targets with the same number of evaluations:
// `sampler_efficiency [SEEDS [BURN_IN]]`, 2000 steps in all, 500 of them burn-in unless told otherwise.
#include "calibration/diagnostics.hpp"
#include "calibration/proposal.hpp"
#include "tests/unit/sampler_targets.hpp"
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace {

using calibration::Chain;
using calibration::Proposal;
using calibration::RandomStream;

constexpr int walkers = 32;
int burn_in = 500, steps = 1500;

Chain sampler(const targets::Target& t, unsigned seed) {
  calibration::SamplerOptions o;
  o.walkers = walkers;
  o.burn_in = burn_in;
  o.steps = steps;
  o.seed = seed;
  o.lower = t.lower;
  o.upper = t.upper;
  return calibration::sample(t.batch(), t.start(200, seed), o);
}

/// Points of the other half of the walkers.
using Propose =
    std::function<Proposal(const Eigen::MatrixXd& others, const Eigen::VectorXd& from, RandomStream&)>;

/// Goodman and Weare 2010, a = 2.
Proposal stretch(const Eigen::MatrixXd& others, const Eigen::VectorXd& from, RandomStream& random) {
  const double root = 1 + random.uniform(), z = root * root / 2;
  const Eigen::VectorXd other = others.col(random.below(int(others.cols())));
  return {calibration::Move::difference, other + z * (from - other), double(from.size() - 1) * std::log(z)};
}

/// As emcee's DEMove and DESnookerMove, four to one (Nelson et al. 2014, ter Braak and Vrugt 2008).
Proposal difference_of_others(const Eigen::MatrixXd& others, const Eigen::VectorXd& from,
                              RandomStream& random) {
  calibration::ProposalKernel kernel;
  kernel.archive = others;
  if (random.uniform() < 0.2) {
    kernel.weight = {0, 0, 1, 0};
    return calibration::propose(kernel, from, random);
  }
  const int one = random.below(int(others.cols()));
  int two = random.below(int(others.cols()) - 1);
  two += two >= one;
  const double factor = 2.38 / std::sqrt(2.0 * double(from.size())) * (1 + 1e-3 * random.normal());
  return {calibration::Move::difference, from + factor * (others.col(one) - others.col(two)), 0};
}

bool within(const targets::Target& t, const Eigen::VectorXd& x) {
  return t.lower.size() == 0 ||
         ((x.array() >= t.lower.array()).all() && (x.array() <= t.upper.array()).all());
}

double value(const targets::Target& t, const Eigen::VectorXd& x) {
  return within(t, x) ? t.log_density(x) : -INFINITY;
}

bool accept(const targets::Target& t, const Proposal& p, Eigen::Ref<Eigen::VectorXd> point,
            double& log_density, RandomStream& random) {
  const double there = value(t, p.point);
  if (!(there - log_density + p.log_ratio > std::log(random.uniform()))) return false;
  point = p.point;
  log_density = there;
  return true;
}

struct Walkers {
  Eigen::MatrixXd points;
  std::vector<double> log_density;
  Chain chain;

  Walkers(const targets::Target& t, unsigned seed) : points(t.mean.size(), walkers) {
    const auto start = t.start(2000, seed);
    for (Eigen::Index i = 0; log_density.size() < walkers; ++i) {
      if (!std::isfinite(value(t, start.col(i)))) continue;
      points.col(Eigen::Index(log_density.size())) = start.col(i);
      log_density.push_back(value(t, start.col(i)));
    }
    chain.dimensions = int(t.mean.size());
    chain.walkers = walkers;
  }
  void keep() {
    chain.samples.insert(chain.samples.end(), points.data(), points.data() + points.size());
    ++chain.steps;
  }
};

/// One half moves against the other.
Chain ensemble(const targets::Target& t, unsigned seed, const Propose& propose) {
  Walkers w(t, seed);
  RandomStream random(seed);
  constexpr int half = walkers / 2;
  for (int step = 0; step < burn_in + steps; ++step) {
    for (const int first : {0, half}) {
      const Eigen::MatrixXd others = w.points.middleCols(half - first, half);
      for (int i = first; i < first + half; ++i)
        accept(t, propose(others, w.points.col(i), random), w.points.col(i), w.log_density[i], random);
    }
    if (step >= burn_in) w.keep();
  }
  return w.chain;
}

/// DE-MC(ZS) of ter Braak and Vrugt 2008 with subspace moves (Vrugt et al. 2009): the archive grows all the time.
Chain with_archive(const targets::Target& t, unsigned seed) {
  Walkers w(t, seed);
  RandomStream random(seed);
  calibration::ProposalKernel kernel;
  kernel.archive = w.points;
  kernel.spread = t.deviation;
  kernel.weight = {0.8, 0.1, 0.1, 0};
  for (int step = 0; step < burn_in + steps; ++step) {
    for (int i = 0; i < walkers; ++i)
      accept(t, propose(kernel, w.points.col(i), random), w.points.col(i), w.log_density[i], random);
    if (step % 10 == 9) {
      kernel.archive.conservativeResize(Eigen::NoChange, kernel.archive.cols() + walkers);
      kernel.archive.rightCols(walkers) = w.points;
    }
    if (step >= burn_in) w.keep();
  }
  return w.chain;
}

struct Outcome {
  double effective = 0; ///< per 1000 evaluations, of the worst dimension
  double rhat = 0;      ///< the largest
  double error = 0;     ///< the largest error of a mean, in deviations of the target
};

Outcome judge(const targets::Target& t, const Chain& chain) {
  Outcome o{1e300, 0, 0};
  for (int i = 0; i < chain.dimensions; ++i) {
    const auto m = calibration::marginal(chain.of(i));
    o.effective = std::min({o.effective, m.bulk_size, m.tail_size});
    o.rhat = std::max(o.rhat, m.rhat);
    o.error = std::max(o.error, std::abs(m.mean - t.mean(i)) / t.deviation(i));
  }
  o.effective *= 1000.0 / (walkers * (burn_in + steps));
  return o;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

} // namespace

int main(int count, char** arguments) {
  const unsigned seeds = count > 1 ? unsigned(std::atoi(arguments[1])) : 5;
  if (count > 2) burn_in = std::clamp(std::atoi(arguments[2]), 20, 1900);
  steps = 2000 - burn_in;
  const std::vector<targets::Target> all = {
      targets::correlated_normal(6), targets::correlated_normal(10), targets::banana(),
      targets::two_modes(),          targets::funnel(1.5),           targets::bounded()};
  using Run = std::function<Chain(const targets::Target&, unsigned)>;
  const std::vector<std::pair<const char*, Run>> methods = {
      {"stretch", [](auto& t, unsigned s) { return ensemble(t, s, stretch); }},
      {"difference of halves", [](auto& t, unsigned s) { return ensemble(t, s, difference_of_others); }},
      {"DE-MC(ZS)", with_archive},
      {"this sampler", sampler}};
  fmt::print("{} walkers, {} + {} steps, median (lowest) of {} seeds; worst dimension\n", walkers, burn_in,
             steps, seeds);
  fmt::print("{:38} {:22} {:>10} {:>8} {:>8} {:>10}\n", "target", "method", "ESS/1000", "(lowest)", "R-hat",
             "|mean| err");
  for (const auto& t : all)
    for (const auto& [name, run] : methods) {
      std::vector<double> effective, rhat, error;
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        const Outcome o = judge(t, run(t, seed));
        effective.push_back(o.effective);
        rhat.push_back(o.rhat);
        error.push_back(o.error);
      }
      fmt::print("{:38} {:22} {:10.1f} {:8.1f} {:8.3f} {:10.3f}\n", t.name, name, median(effective),
                 *std::min_element(effective.begin(), effective.end()), median(rhat), median(error));
      std::fflush(stdout);
    }
}
