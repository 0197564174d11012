// SPDX-License-Identifier: BSD-3-Clause
// Diagnostics against an independent program (diagnostics_reference.py), closed forms, and chains that are bad.
#include "calibration/diagnostics.hpp"
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace {

/// Chains x_t = r x_{t-1} + noise of deviation 1, each about its own centre.
Eigen::MatrixXd autoregressive(int steps, int chains, double r, double centres_apart, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd draws(steps, chains);
  for (int c = 0; c < chains; ++c) {
    double x = normal(random);
    for (int s = 0; s < steps; ++s) {
      draws(s, c) = x + c * centres_apart;
      x = r * x + std::sqrt(1 - r * r) * normal(random);
    }
  }
  return draws;
}

std::map<std::string, double> reference(const Eigen::MatrixXd& draws) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("simsand_draws_{}.csv", ::getpid());
  std::ofstream stream(file);
  for (const auto& row : draws.rowwise())
    for (Eigen::Index c = 0; c < row.size(); ++c)
      stream << fmt::format("{:.17g}{}", row(c), c + 1 < row.size() ? "," : "\n");
  stream.close();
  const std::string command = fmt::format("/usr/bin/python3 {}/tests/unit/diagnostics_reference.py {}",
                                          SIMSAND_SOURCE_DIR, file.string());
  std::map<std::string, double> values;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  char name[64];
  double value;
  while (pipe && std::fscanf(pipe, "%63s %lf", name, &value) == 2) values[name] = value;
  if (pipe) ::pclose(pipe);
  std::filesystem::remove(file);
  return values;
}

TEST(Diagnostics, AsAnIndependentProgram) {
  std::vector<Eigen::MatrixXd> cases = {
      autoregressive(200, 4, 0, 0, 1), autoregressive(251, 3, 0.7, 0, 2), autoregressive(120, 5, 0.95, 0, 3),
      autoregressive(100, 4, 0.3, 0.4, 4), autoregressive(90, 4, -0.6, 0, 5)};
  cases.push_back(cases[0].array().exp().pow(3));  // heavy tail
  cases.push_back((cases[1].array() * 2).round()); // many equal values
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto expected = reference(cases[i]);
    ASSERT_EQ(expected.size(), 8u);
    const auto m = calibration::marginal(cases[i]);
    const auto same = [&](double value, const char* name) {
      EXPECT_NEAR(value, expected[name], 1e-9 * std::abs(expected[name])) << name << " of case " << i;
    };
    same(m.rhat, "rhat");
    same(m.bulk_size, "bulk");
    same(m.tail_size, "tail");
    same(m.mean_error, "mean_error");
    same(m.lower_error, "lower_error");
    same(m.equal_tailed.lower, "lower");
    same(m.equal_tailed.upper, "upper");
    same(m.shortest.lower, "shortest");
  }
}

/// n (1 - r) / (1 + r) effective draws of the mean of an autoregressive chain.
TEST(Diagnostics, EffectiveSizeOfAutoregressiveChains) {
  for (const double r : {0.0, 0.5, 0.9, -0.5}) {
    const auto draws = autoregressive(20000, 8, r, 0, 7);
    const double exact = 160000 * (1 - r) / (1 + r);
    EXPECT_NEAR(calibration::effective_size(draws) / exact, 1, 0.06) << r;
    EXPECT_NEAR(calibration::bulk_effective_size(draws) / exact, 1, 0.06) << r;
    EXPECT_NEAR(calibration::error_of_mean(draws), std::sqrt(1 / exact), 0.04 * std::sqrt(1 / exact)) << r;
    EXPECT_NEAR(calibration::split_rhat(draws), 1, 0.003) << r;
  }
}

/// The errors that are reported are those that happen, over 400 repetitions.
TEST(Diagnostics, ErrorsAreAsLargeAsTheySay) {
  double mean = 0, lower = 0, mean_said = 0, lower_said = 0;
  constexpr int repetitions = 400;
  for (int i = 0; i < repetitions; ++i) {
    const auto draws = autoregressive(500, 4, 0.6, 0, 100 + i);
    mean += std::pow(draws.mean(), 2) / repetitions;
    lower += std::pow(calibration::quantile(draws, 0.05) + 1.6448536, 2) / repetitions;
    mean_said += calibration::error_of_mean(draws) / repetitions;
    lower_said += calibration::error_of_quantile(draws, 0.05) / repetitions;
  }
  EXPECT_NEAR(std::sqrt(mean) / mean_said, 1, 0.12); // 400 repetitions give a deviation to 3.5 %
  EXPECT_NEAR(std::sqrt(lower) / lower_said, 1, 0.12);
}

TEST(Diagnostics, Intervals) {
  Eigen::MatrixXd draws(1001, 1);
  for (int i = 0; i <= 1000; ++i) draws(i, 0) = std::pow(i / 1000.0, 2); // density 1 / (2 sqrt x)
  EXPECT_NEAR(calibration::quantile(draws, 0.5), 0.25, 1e-12);
  const auto tails = calibration::equal_tailed_interval(draws, 0.9);
  EXPECT_NEAR(tails.lower, 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(tails.upper, 0.95 * 0.95, 1e-12);
  const auto shortest = calibration::shortest_interval(draws, 0.9);
  EXPECT_EQ(shortest.lower, 0);
  EXPECT_NEAR(shortest.upper, 0.81, 1e-3);
}

calibration::Chain chain_of(const std::vector<Eigen::MatrixXd>& dimensions) {
  calibration::Chain chain;
  chain.dimensions = int(dimensions.size());
  chain.steps = int(dimensions[0].rows());
  chain.walkers = int(dimensions[0].cols());
  chain.acceptance = 0.3;
  for (int s = 0; s < chain.steps; ++s)
    for (int w = 0; w < chain.walkers; ++w)
      for (const auto& d : dimensions) chain.samples.push_back(d(s, w));
  return chain;
}

std::string reasons(const calibration::Chain& chain) {
  const auto d = calibration::diagnose(chain, {"phi", "e_ref"});
  EXPECT_EQ(d.verdict.converged, d.verdict.reasons.empty());
  return fmt::format("{}", fmt::join(d.verdict.reasons, "; "));
}

TEST(Diagnostics, VerdictNamesWhatIsWrong) {
  const auto good = autoregressive(1000, 4, 0.2, 0, 1);
  EXPECT_EQ(reasons(chain_of({good, autoregressive(1000, 4, 0.2, 0, 2)})), "");
  const auto says = [](const calibration::Chain& chain, const std::string& what) {
    const std::string said = reasons(chain);
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  says(chain_of({good, autoregressive(1000, 4, 0.2, 0.3, 2)}), "e_ref: R-hat 1.");
  says(chain_of({good, autoregressive(1000, 4, 0.98, 0, 2)}), "e_ref: R-hat 1.");
  says(chain_of({autoregressive(1000, 4, 0.9, 0, 2)}), "effective samples of the centre, 400 needed");
  says(chain_of({autoregressive(1000, 4, 0.97, 0, 2)}), "effective samples of the tails, 400 needed");
  says(chain_of({good, Eigen::MatrixXd::Constant(1000, 4, 0.1)}), "e_ref: all samples are equal");
  says(chain_of({autoregressive(60, 100, 0, 0, 1)}), "60 kept steps of each walker, 100 needed");
  says(chain_of({autoregressive(5, 4, 0, 0, 1)}), "5 kept steps");
  auto chain = chain_of({good});
  chain.acceptance = 0.002;
  says(chain, "acceptance 0.0020");
  Eigen::MatrixXd one_stands = good;
  one_stands.col(2).setConstant(0.3);
  says(chain_of({one_stands}), "a walker never moved");
  // Chains that agree in the centre and not in the spread: only the folded R-hat sees it.
  Eigen::MatrixXd one_is_wide = good;
  one_is_wide.col(1) *= 2;
  says(chain_of({one_is_wide}), "phi: R-hat 1.");
  // A trend that all chains share: only splitting sees it.
  says(chain_of({good.colwise() + Eigen::VectorXd::LinSpaced(1000, 0, 1)}), "phi: R-hat 1.");
}

TEST(Diagnostics, Correlation) {
  const auto one = autoregressive(1000, 4, 0, 0, 1), noise = autoregressive(1000, 4, 0, 0, 2);
  const auto d = calibration::diagnose(chain_of({one, 0.6 * one + 0.8 * noise, -one}), {});
  EXPECT_NEAR(d.correlation(0, 1), 0.6, 0.03);
  EXPECT_NEAR(d.correlation(0, 2), -1, 1e-12);
  EXPECT_NEAR(d.correlation(1, 1), 1, 1e-12);
}

} // namespace
