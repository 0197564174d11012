// SPDX-License-Identifier: BSD-3-Clause
// The sampler draws from the density it is given: moments of known densities, stationarity of every move, coverage.
#include "calibration/diagnostics.hpp"
#include "calibration/proposal.hpp"
#include "tests/unit/sampler_targets.hpp"
#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>
#include <omp.h>

namespace {

using calibration::Chain;
using calibration::SamplerOptions;

SamplerOptions options(int walkers, int burn_in, int steps, unsigned seed = 1) {
  SamplerOptions o;
  o.walkers = walkers;
  o.burn_in = burn_in;
  o.steps = steps;
  o.seed = seed;
  return o;
}

Chain run(const targets::Target& t, SamplerOptions o) {
  o.lower = t.lower;
  o.upper = t.upper;
  return calibration::sample(t.batch(), t.start(200, 7), o);
}

/// Mean of `draws` within four Monte Carlo standard errors of `exact`.
void expect_mean(const Eigen::MatrixXd& draws, double exact, const std::string& what) {
  const double error = calibration::error_of_mean(draws);
  EXPECT_LT(std::abs(draws.mean() - exact), 4 * error) << what << ": " << draws.mean() << " for " << exact;
  EXPECT_GT(calibration::effective_size(draws), 300) << what << ": too few to say anything";
}

void expect_moments(const targets::Target& t, const Chain& chain) {
  for (int i = 0; i < chain.dimensions; ++i) {
    const Eigen::MatrixXd draws = chain.of(i);
    expect_mean(draws, t.mean(i), t.name + ", mean " + std::to_string(i));
    expect_mean((draws.array() - t.mean(i)).square(), t.deviation(i) * t.deviation(i),
                t.name + ", variance " + std::to_string(i));
  }
}

TEST(Sampler, CorrelatedNormal) {
  for (const int d : {6, 10}) {
    const auto t = targets::correlated_normal(d);
    const Chain chain = run(t, options(32, 1000, 1500));
    expect_moments(t, chain);
    for (int i = 0; i + 1 < d; ++i) {
      const Eigen::MatrixXd one = chain.of(i).array() - t.mean(i),
                            next = chain.of(i + 1).array() - t.mean(i + 1);
      expect_mean(one.cwiseProduct(next) / (t.deviation(i) * t.deviation(i + 1)), 0.95, "correlation");
    }
    const auto diagnosis = calibration::diagnose(chain, {});
    EXPECT_TRUE(diagnosis.verdict.converged) << diagnosis.verdict.reasons.front();
    EXPECT_NEAR(diagnosis.correlation(0, 2), 0.95 * 0.95, 0.02);
  }
}

/// Thin curved tails are sampled too little in some runs, by more than the Monte Carlo errors say (SAMPLER.md,
/// Limits): held to 8 % of the variance here.
TEST(Sampler, Banana) {
  const auto t = targets::banana();
  const Chain chain = run(t, options(64, 2000, 4000));
  for (int i = 0; i < 2; ++i) {
    const Eigen::ArrayXXd away = chain.of(i).array() - t.mean(i);
    EXPECT_NEAR(away.mean() / t.deviation(i), 0, 0.08) << i;
    EXPECT_NEAR(away.square().mean() / std::pow(t.deviation(i), 2), 1, i == 0 ? 0.08 : 0.3) << i;
  }
  for (int i = 2; i < 6; ++i) expect_mean(chain.of(i), 0, "straight dimension");
}

TEST(Sampler, MassOfTwoModes) {
  const auto t = targets::two_modes();
  const Chain chain = run(t, options(32, 1000, 1500));
  expect_moments(t, chain);
  expect_mean((chain.of(0).array() < 0).cast<double>(), 1.0 / 3, "mass of the lesser mode");
}

TEST(Sampler, Funnel) {
  const auto t = targets::funnel(1.5);
  const Chain chain = run(t, options(64, 2000, 4000));
  expect_mean(chain.of(0), 0, "mean of v");
  EXPECT_NEAR(chain.of(0).array().square().mean() / 2.25, 1, 0.08); // as for the banana
  expect_mean(chain.of(1), 0, "mean of x");
  expect_mean((chain.of(1).array().square() < 1).cast<double>(), 0.66245, "part of x within 1");
}

TEST(Sampler, HardBounds) {
  auto t = targets::bounded();
  expect_moments(t, run(t, options(32, 1000, 2500)));
  // The same bounds told by the density alone.
  t.log_density = [f = t.log_density, low = t.lower, high = t.upper](const Eigen::VectorXd& x) {
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all() ? f(x) : -INFINITY;
  };
  const Chain bounds = run(t, options(16, 100, 50));
  t.lower.resize(0);
  t.upper.resize(0);
  EXPECT_EQ(bounds.samples, run(t, options(16, 100, 50)).samples);
}

/// 20,000 exact draws of a normal density in three dimensions stay such under each move alone, whose archive is of
/// quite another density.
TEST(Sampler, EveryMoveLeavesTheDensityAsItIs) {
  calibration::RandomStream random(3);
  Eigen::VectorXd centre(3);
  Eigen::MatrixXd factor(3, 3);
  centre << 1, -2, 0.5;
  factor << 1, 0, 0, 0.8, 0.5, 0, -0.3, 0.4, 0.7;
  const auto log_density = [&](const Eigen::VectorXd& x) {
    return -0.5 * factor.triangularView<Eigen::Lower>().solve(x - centre).squaredNorm();
  };
  const auto normal = [&] {
    Eigen::VectorXd z(3);
    for (auto& x : z) x = random.normal();
    return z;
  };
  Eigen::MatrixXd archive(3, 300);
  for (auto column : archive.colwise()) column = 1.5 * normal();
  for (int move = 0; move < calibration::moves; ++move) {
    std::array<double, calibration::moves> weight{};
    weight[move] = 1;
    const auto kernel = calibration::fit_kernel(archive, weight, random);
    constexpr int walkers = 20000;
    int accepted = 0;
    Eigen::MatrixXd ends(3, walkers);
    for (int w = 0; w < walkers; ++w) {
      Eigen::VectorXd x = centre + factor * normal();
      for (int step = 0; step < 10; ++step) {
        const auto p = calibration::propose(kernel, x, random);
        EXPECT_EQ(int(p.move), move);
        if (!(log_density(p.point) - log_density(x) + p.log_ratio > std::log(random.uniform()))) continue;
        x = p.point;
        ++accepted;
      }
      ends.col(w) =
          factor.triangularView<Eigen::Lower>().solve(x - centre); // standard normal if the density is kept
    }
    EXPECT_GT(accepted, walkers / 4) << "move " << move; // else the move is hardly tested
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(ends.row(i).mean(), 0, 4 / std::sqrt(walkers)) << "move " << move;
      EXPECT_NEAR(ends.row(i).squaredNorm() / walkers, 1, 4 * std::sqrt(2.0 / walkers)) << "move " << move;
      const auto rarely = (ends.row(i).array() > 1.6449).count() / double(walkers);
      EXPECT_NEAR(rarely, 0.05, 4 * std::sqrt(0.05 * 0.95 / walkers)) << "move " << move;
      EXPECT_NEAR(ends.row(i).dot(ends.row((i + 1) % 3)) / walkers, 0, 4 / std::sqrt(walkers))
          << "move " << move;
    }
  }
}

/// Simulation-based calibration (Talts et al. 2018): parameters drawn from the prior N(0, I), data y = A x + noise;
/// then the rank of the truth among posterior draws is uniform, and 90 % intervals hold it nine times in ten.
TEST(Sampler, IntervalsCoverTheTruthAsOftenAsTheySay) {
  constexpr int problems = 300, dimensions = 3, data = 5, bins = 10;
  calibration::RandomStream random(11);
  const auto normals = [&](int rows, int columns) {
    Eigen::MatrixXd m(rows, columns);
    for (auto& x : m.reshaped()) x = random.normal();
    return m;
  };
  Eigen::ArrayXXi counts = Eigen::ArrayXXi::Zero(bins, dimensions);
  Eigen::ArrayXi covered = Eigen::ArrayXi::Zero(dimensions);
  for (int problem = 0; problem < problems; ++problem) {
    const Eigen::MatrixXd slope = normals(data, dimensions);
    const Eigen::VectorXd truth = normals(dimensions, 1), measured = slope * truth + 0.5 * normals(data, 1);
    const auto density = [&](const Eigen::Ref<const Eigen::MatrixXd>& points) {
      const Eigen::MatrixXd misfit = (slope * points).colwise() - measured;
      return Eigen::VectorXd(-2 * misfit.colwise().squaredNorm() - 0.5 * points.colwise().squaredNorm());
    };
    const Chain chain =
        calibration::sample(density, 3 * normals(dimensions, 40), options(16, 150, 150, unsigned(problem)));
    for (int i = 0; i < dimensions; ++i) {
      const Eigen::MatrixXd draws = chain.of(i);
      const auto interval = calibration::equal_tailed_interval(draws, 0.9);
      covered(i) += truth(i) >= interval.lower && truth(i) <= interval.upper;
      const double below = double((draws.array() < truth(i)).count()) / double(draws.size());
      ++counts(std::min(bins - 1, int(below * bins)), i);
    }
  }
  for (int i = 0; i < dimensions; ++i) {
    EXPECT_NEAR(covered(i) / double(problems), 0.9, 3 * std::sqrt(0.9 * 0.1 / problems)) << i;
    const double expected = double(problems) / bins;
    const double squares = (counts.col(i).cast<double>() - expected).square().sum() / expected;
    EXPECT_LT(squares, gsl_cdf_chisq_Pinv(0.999, bins - 1)) << counts.col(i).transpose();
  }
}

/// Threads in the density, and more of them than cores.
TEST(Sampler, SameForAnyNumberOfThreads) {
  const auto t = targets::banana();
  std::vector<Chain> chains;
  for (const int threads : {1, 2, 5}) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    const auto density = [&](const Eigen::Ref<const Eigen::MatrixXd>& points) {
      Eigen::VectorXd values(points.cols());
#pragma omp parallel for schedule(dynamic, 1)
      for (Eigen::Index i = 0; i < points.cols(); ++i) values(i) = t.log_density(points.col(i));
      return values;
    };
    chains.push_back(calibration::sample(density, t.start(100, 1), options(20, 60, 40)));
    omp_set_num_threads(before);
  }
  EXPECT_EQ(chains[0].samples, chains[1].samples);
  EXPECT_EQ(chains[0].samples, chains[2].samples);
}

TEST(Sampler, SeedsDiffer) {
  const auto t = targets::banana();
  EXPECT_NE(run(t, options(8, 50, 10, 1)).samples, run(t, options(8, 50, 10, 2)).samples);
  EXPECT_EQ(run(t, options(8, 50, 10, 1)).samples, run(t, options(8, 50, 10, 1)).samples);
}

/// Neal's funnel of deviation 3 is beyond this sampler: it must say so.
TEST(Sampler, TooNarrowFunnelIsNotCalledConverged) {
  const Chain chain = run(targets::funnel(3), options(32, 500, 1500));
  EXPECT_FALSE(calibration::diagnose(chain, {}).verdict.converged);
}

/// Two modes of which the start knows one only, too far apart for a jump: the walkers agree with each other. No
/// diagnostics can see this; a start spread over both can.
TEST(Sampler, ModeIsFoundOnlyFromAStartThatReachesIt) {
  auto t = targets::two_modes();
  t.start_high = targets::all(6, -3);
  t.start_low = targets::all(6, -5);
  const Chain narrow = run(t, options(32, 500, 500));
  EXPECT_EQ((narrow.of(0).array() > 0).count(), 0);
}

std::string failure(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(Sampler, BadInputIsNamed) {
  auto t = targets::banana();
  const auto said = [&](const SamplerOptions& o) { return failure([&] { run(t, o); }); };
  EXPECT_NE(said(options(2, 100, 10)).find("walkers = 2"), std::string::npos);
  EXPECT_NE(said(options(8, 0, 10)).find("burn_in = 0"), std::string::npos);
  EXPECT_NE(said(options(8, 100, 0)).find("steps = 0"), std::string::npos);
  EXPECT_NE(said(options(300, 100, 10)).find("200 of 200 starting points"), std::string::npos);
  t.lower = targets::all(2, 0);
  EXPECT_NE(said(options(8, 100, 10)).find("2 bounds for 6 dimensions"), std::string::npos);
  t.lower.resize(0);
  t.log_density = [](const Eigen::VectorXd& x) { return x(0) > 0 ? NAN : 0.0; };
  EXPECT_NE(said(options(8, 100, 10)).find("log density is nan at ("), std::string::npos);
  t.log_density = [](const Eigen::VectorXd&) { return -INFINITY; };
  EXPECT_NE(said(options(8, 100, 10)).find("0 of 200 starting points"), std::string::npos);
  t = targets::banana();
  t.start_low(3) = t.start_high(3) = 1;
  EXPECT_NE(said(options(8, 100, 10)).find("subspace"), std::string::npos);
}

} // namespace
