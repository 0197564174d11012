// SPDX-License-Identifier: BSD-3-Clause
// Densities of known moments, for tests and comparison of samplers.
#pragma once
#include "calibration/sampler.hpp"
#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace targets {

struct Target {
  std::string name;
  std::function<double(const Eigen::VectorXd&)> log_density;
  Eigen::VectorXd mean, deviation;       ///< exact
  Eigen::VectorXd start_low, start_high; ///< starting points are uniform in this box
  Eigen::VectorXd lower, upper;          ///< hard bounds or empty

  calibration::LogDensity batch() const {
    return [f = log_density](const Eigen::Ref<const Eigen::MatrixXd>& points) {
      Eigen::VectorXd values(points.cols());
      for (Eigen::Index i = 0; i < points.cols(); ++i) values(i) = f(points.col(i));
      return values;
    };
  }
  Eigen::MatrixXd start(int count, unsigned seed) const {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> part(0, 1);
    Eigen::MatrixXd points(mean.size(), count);
    for (auto& x : points.reshaped()) x = part(random);
    return (start_high - start_low).asDiagonal() * points + start_low.replicate(1, count);
  }
};

inline Eigen::VectorXd all(int d, double value) {
  return Eigen::VectorXd::Constant(d, value);
}

/// Correlation 0.95^|i - j|, deviations from 1 to 1000, started far to one side.
inline Target correlated_normal(int d) {
  Target t{"normal, " + std::to_string(d) + " dimensions, correlated", {}, {}, {}, {}, {}, {}, {}};
  Eigen::MatrixXd covariance(d, d);
  const auto scale = [d](int i) { return std::pow(1000.0, double(i) / (d - 1)); };
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) covariance(i, j) = scale(i) * scale(j) * std::pow(0.95, std::abs(i - j));
  t.deviation = covariance.diagonal().cwiseSqrt();
  t.mean = 3 * t.deviation;
  t.start_low = t.mean - 5 * t.deviation;
  t.start_high = t.mean + 15 * t.deviation;
  t.log_density = [factor = Eigen::LLT<Eigen::MatrixXd>(covariance),
                   mean = t.mean](const Eigen::VectorXd& x) {
    return -0.5 * factor.matrixL().solve(x - mean).squaredNorm();
  };
  return t;
}

/// Haario, Saksman and Tamminen 1999: a normal density bent along a parabola, b = 0.03, in 6 dimensions.
inline Target banana() {
  const double b = 0.03;
  Target t{"banana, 6 dimensions", {}, all(6, 0), all(6, 1), all(6, -20), all(6, 20), {}, {}};
  t.deviation(0) = 10;
  t.deviation(1) = std::sqrt(1 + 2 * b * b * 1e4);
  t.log_density = [b](const Eigen::VectorXd& x) {
    const double y = x(1) + b * x(0) * x(0) - 100 * b;
    return -0.5 * (x(0) * x(0) / 100 + y * y + x.tail(4).squaredNorm());
  };
  return t;
}

/// A third of the mass at -4, two thirds at 4, in 6 dimensions: the modes are 20 deviations apart.
inline Target two_modes() {
  Target t{"two modes, 6 dimensions",
           {},
           all(6, 4.0 / 3),
           all(6, std::sqrt(1 + 128.0 / 9)),
           all(6, -10),
           all(6, 10),
           {},
           {}};
  t.log_density = [](const Eigen::VectorXd& x) {
    const double one = std::log(1.0 / 3) - 0.5 * (x.array() + 4).square().sum();
    const double two = std::log(2.0 / 3) - 0.5 * (x.array() - 4).square().sum();
    return std::max(one, two) + std::log1p(std::exp(-std::abs(one - two)));
  };
  return t;
}

/// Neal 2003, x_i of variance exp(v), v of the given deviation, in 5 dimensions.
inline Target funnel(double deviation) {
  Target t{"funnel, 5 dimensions",
           {},
           all(5, 0),
           all(5, std::exp(deviation * deviation / 4)),
           all(5, -5),
           all(5, 5),
           {},
           {}};
  t.deviation(0) = deviation;
  t.log_density = [deviation](const Eigen::VectorXd& x) {
    const double v = x(0);
    return -0.5 * (v * v / deviation / deviation + x.tail(4).squaredNorm() * std::exp(-v)) - 2 * v;
  };
  return t;
}

/// Two uniform, two half normal, two exponential dimensions: most of the mass lies at hard bounds.
inline Target bounded() {
  Target t{
      "hard bounds, 6 dimensions", {}, all(6, 1), all(6, 1), all(6, 0), all(6, 4), all(6, 0), all(6, 1e3)};
  t.upper.head(2).setOnes();
  t.start_high.head(2).setOnes();
  t.mean << 0.5, 0.5, std::sqrt(2 / std::numbers::pi), std::sqrt(2 / std::numbers::pi), 1, 1;
  t.deviation << std::sqrt(1.0 / 12), std::sqrt(1.0 / 12), std::sqrt(1 - 2 / std::numbers::pi),
      std::sqrt(1 - 2 / std::numbers::pi), 1, 1;
  t.log_density = [](const Eigen::VectorXd& x) {
    return -0.5 * x.segment(2, 2).squaredNorm() - x.tail(2).sum();
  };
  return t;
}

} // namespace targets
