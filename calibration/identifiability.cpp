// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/identifiability.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace calibration {
namespace {

constexpr double range_precision = 12;  // 1 / variance of a uniform distribution over a unit range
constexpr double bound_distance = 2e-3; // of the range

Finding finding_of(double u, double deviation, const FreeParameter& p) {
  const double at = (u - p.lowest()) / (p.highest() - p.lowest());
  if (at < bound_distance) return Finding::at_lower_bound;
  if (at > 1 - bound_distance) return Finding::at_upper_bound;
  if (deviation > undetermined_deviation) return Finding::undetermined;
  return deviation > weak_deviation ? Finding::weak : Finding::determined;
}

} // namespace

Identifiability identify(const Objective& objective, const BestFit& fit) {
  const int d = objective.fit.parameters();
  Eigen::VectorXd range(d);
  for (int k = 0; k < d; ++k)
    range[k] = objective.fit.unknowns[k].highest() - objective.fit.unknowns[k].lowest();
  const Eigen::MatrixXd scaled = fit.jacobian * range.asDiagonal();
  // The normal matrix loses singular values below 1e-8 of the largest, which are far from being determined.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled.transpose() * scaled);
  Identifiability out;
  // With fewer rows than parameters the misfit says nothing about the errors: no inflation.
  out.inflation = fit.degrees > 0 ? std::max(1.0, fit.chi_squared / fit.degrees) : 1;
  const Eigen::VectorXd precision =
      solver.eigenvalues().cwiseMax(0.0) / out.inflation + Eigen::VectorXd::Constant(d, range_precision);
  const Eigen::MatrixXd& axes = solver.eigenvectors();
  const Eigen::MatrixXd covariance = axes * precision.cwiseInverse().asDiagonal() * axes.transpose();
  out.deviation = covariance.diagonal().cwiseSqrt();
  out.correlation =
      out.deviation.cwiseInverse().asDiagonal() * covariance * out.deviation.cwiseInverse().asDiagonal();
  out.covariance = range.asDiagonal() * covariance * range.asDiagonal();
  for (int k = d - 1; k >= 0; --k) {
    Combination c{std::sqrt(std::max(solver.eigenvalues()[k], 0.0)), 1 / std::sqrt(precision[k]), axes.col(k),
                  true};
    Eigen::Index largest = 0;
    c.weights.cwiseAbs().maxCoeff(&largest);
    if (c.weights[largest] < 0) c.weights = -c.weights;
    c.determined = c.deviation < undetermined_deviation;
    out.combinations.push_back(c);
  }
  for (int k = 0; k < d; ++k)
    out.findings.push_back(finding_of(fit.best.end[k], out.deviation[k], objective.fit.unknowns[k]));
  return out;
}

std::string_view describe(Finding finding) {
  switch (finding) {
  case Finding::determined:
    return "determined";
  case Finding::weak:
    return "WEAKLY determined";
  case Finding::undetermined:
    return "NOT determined by these tests";
  case Finding::at_lower_bound:
    return "AT ITS LOWER BOUND";
  case Finding::at_upper_bound:
    return "AT ITS UPPER BOUND";
  }
  return "";
}

} // namespace calibration
