// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/objective.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace calibration {
namespace {

/// Running mean over up to `reach` rows on both sides, which removes most of the noise.
std::vector<double> smoothed(const std::vector<double>& values, long reach) {
  const long n = long(values.size());
  std::vector<double> out(n);
  for (long i = 0; i < n; ++i) {
    const long r = std::min({reach, i, n - 1 - i});
    out[i] = std::accumulate(values.begin() + i - r, values.begin() + i + r + 1, 0.0) / double(2 * r + 1);
  }
  return out;
}

double largest_magnitude(const std::vector<double>& values) {
  double peak = 0;
  for (double v : values) peak = std::max(peak, std::abs(v));
  return peak;
}

/// Position of each row along its curve. By arc: the length of the curve of value over strain, each divided by its range,
/// through about 25 means of neighbouring rows, so that noise and outliers do not lengthen it.
std::vector<double> positions(const LabTest& test, const std::vector<double>& values, Weighting by) {
  const long n = long(values.size());
  std::vector<double> at(n);
  if (by == Weighting::rows) {
    std::iota(at.begin(), at.end(), 0.0);
    return at;
  }
  if (by == Weighting::strain) {
    for (long i = 0; i < n; ++i) at[i] = std::abs(test.strain[i]);
    return at;
  }
  const long stride = std::max(1L, n / 25);
  const auto smooth = smoothed(values, stride);
  const auto [low, high] = std::minmax_element(smooth.begin(), smooth.end());
  const double height = std::max(*high - *low, 1e-300),
               width = std::max(std::abs(test.strain.back()), 1e-300);
  double length = 0;
  for (long from = 0; from + 1 < n; from += stride) {
    const long to = from + 2 * stride > n - 1 ? n - 1 : from + stride;
    const double step =
        std::hypot((test.strain[to] - test.strain[from]) / width, (smooth[to] - smooth[from]) / height);
    for (long i = from; i <= to; ++i) at[i] = length + step * double(i - from) / double(to - from);
    length += step;
    if (to == n - 1) break;
  }
  return at;
}

/// Part of the length that belongs to each row: half of the distance between its neighbours.
std::vector<double> shares(const std::vector<double>& at) {
  const std::size_t n = at.size();
  std::vector<double> out(n, 1.0);
  if (n < 2 || !(at.back() > at.front())) return std::vector<double>(n, 1.0 / double(n));
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? at[i] - at[i - 1] : at[1] - at[0];
    const double after = i + 1 < n ? at[i + 1] - at[i] : at[n - 1] - at[n - 2];
    out[i] = 0.5 * (before + after);
  }
  const double sum = std::accumulate(out.begin(), out.end(), 0.0);
  for (double& s : out) s /= sum;
  return out;
}

/// Kish's effective number of rows.
double effective_rows(const std::vector<double>& share) {
  double squares = 0;
  for (double s : share) squares += s * s;
  return 1 / squares;
}

WeighedCurve weighed_curve(const Fit& fit, std::size_t test, const Curve& curve) {
  const auto& of = fit.tests[test];
  WeighedCurve c;
  c.test = test;
  c.measure = curve.measure;
  c.measured = curve.values;
  c.share = shares(positions(of, curve.values, fit.weighting));
  c.peak = std::max(largest_magnitude(smoothed(curve.values, long(curve.values.size()) / 40)), 1e-300);
  c.independent_rows = effective_rows(c.share);
  c.weight = of.weight * fit.errors[std::size_t(curve.measure)].weight;
  return c;
}

} // namespace

Objective::Objective(const Fit& from) : fit(from), pool(std::make_unique<Pool>()) {
  for (const bool held_out : {false, true}) {
    for (std::size_t t = 0; t < fit.tests.size(); ++t)
      if (fit.tests[t].held_out == held_out)
        for (const auto& curve : fit.tests[t].curves) {
          curves.push_back(weighed_curve(fit, t, curve));
          curves.back().first_row = fitted_rows;
          if (!held_out) fitted_rows += curve.values.size();
        }
    if (!held_out) fitted_curves = curves.size();
  }
  for (const auto& test : fit.tests) specimens.push_back(test.specimen);
  std::vector<std::vector<double>> values;
  for (const auto& c : curves) values.push_back(smoothed(c.measured, long(c.measured.size()) / 40));
  set_errors(values);
}

void Objective::set_errors(const std::vector<std::vector<double>>& values) {
  for (std::size_t k = 0; k < curves.size(); ++k) {
    auto& c = curves[k];
    const auto& e = fit.errors[std::size_t(c.measure)];
    c.error.resize(c.measured.size());
    for (std::size_t i = 0; i < c.error.size(); ++i) {
      const double v = std::isfinite(values[k][i]) ? values[k][i] : c.measured[i];
      c.error[i] = std::hypot(e.absolute, e.relative * v, e.of_peak * c.peak);
    }
  }
}

std::vector<double> Objective::properties(const Eigen::VectorXd& u) const {
  auto props = fit.material.material.properties;
  for (Eigen::Index d = 0; d < u.size(); ++d)
    if (const auto& p = fit.unknowns[d]; p.property >= 0) props[p.property] = p.value(u[d]);
  return props;
}

double Objective::model_error(const WeighedCurve& curve, const Eigen::VectorXd& u) const {
  const auto& e = fit.errors[std::size_t(curve.measure)];
  return curve.peak * (e.free_model < 0 ? e.model : fit.unknowns[e.free_model].value(u[e.free_model]));
}

template <class Use> void Objective::with_paths(const Eigen::VectorXd& u, const Use& use) const {
  std::unique_ptr<Simulator> simulator;
  {
    const std::lock_guard lock(pool->mutex);
    ++pool->simulations;
    if (!pool->idle.empty()) {
      simulator = std::move(pool->idle.back());
      pool->idle.pop_back();
    }
  }
  if (!simulator) simulator = std::make_unique<Simulator>(fit.material, specimens);
  const auto paths = simulator->run(properties(u));
  const bool failed = std::any_of(paths.begin(), paths.end(), [](const Path& p) { return !p.complete; });
  use(paths);
  const std::lock_guard lock(pool->mutex);
  pool->failures += failed;
  pool->idle.push_back(std::move(simulator));
}

std::vector<std::vector<double>> Objective::predict(const Eigen::VectorXd& u) const {
  std::vector<std::vector<double>> out;
  with_paths(u, [&](std::span<const Path> paths) {
    for (const auto& c : curves) {
      const auto& test = fit.tests[c.test];
      std::vector<double> values(test.strain.size(), std::numeric_limits<double>::quiet_NaN());
      interpolate(paths[c.test], test.specimen, c.measure, test.strain, values);
      out.push_back(std::move(values));
    }
  });
  return out;
}

std::size_t Objective::residual_count() const {
  return fitted_rows + std::size_t(std::count_if(fit.unknowns.begin(), fit.unknowns.end(),
                                                 [](const auto& p) { return p.has_prior_residual(); }));
}

Eigen::MatrixXd Objective::residuals(const Eigen::Ref<const Eigen::MatrixXd>& points) const {
  Eigen::MatrixXd out(Eigen::Index(residual_count()), points.cols());
#pragma omp parallel for schedule(dynamic)
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    const Eigen::VectorXd u = points.col(j);
    std::vector<double> values;
    with_paths(u, [&](std::span<const Path> paths) {
      for (std::size_t k = 0; k < fitted_curves; ++k) {
        const auto& c = curves[k];
        const auto& test = fit.tests[c.test];
        values.resize(test.strain.size());
        const auto reached = interpolate(paths[c.test], test.specimen, c.measure, test.strain, values);
        const double model = model_error(c, u), counted = c.weight * c.independent_rows;
        for (std::size_t i = 0; i < values.size(); ++i) {
          double z =
              i < reached ? (c.measured[i] - values[i]) / std::hypot(c.error[i], model) : failed_residual;
          if (!std::isfinite(z)) z = failed_residual;
          out(Eigen::Index(c.first_row + i), j) = std::sqrt(counted * c.share[i]) * z;
        }
      }
    });
    Eigen::Index row = Eigen::Index(fitted_rows);
    for (Eigen::Index d = 0; d < u.size(); ++d)
      if (const auto& p = fit.unknowns[d]; p.has_prior_residual()) out(row++, j) = p.prior_residual(u[d]);
  }
  return out;
}

Eigen::VectorXd Objective::log_posterior(const Eigen::Ref<const Eigen::MatrixXd>& points) const {
  Eigen::VectorXd out(points.cols());
#pragma omp parallel for schedule(dynamic)
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    const Eigen::VectorXd u = points.col(j);
    double sum = 0;
    for (Eigen::Index d = 0; d < u.size(); ++d) sum += fit.unknowns[d].log_prior(u[d]);
    if (std::isfinite(sum)) {
      const Eigen::VectorXd r = residuals(u);
      sum -= 0.5 * r.head(Eigen::Index(fitted_rows)).squaredNorm();
      for (std::size_t k = 0; k < fitted_curves; ++k) {
        const auto& c = curves[k];
        const double model = model_error(c, u);
        double logs = 0;
        if (fit.errors[std::size_t(c.measure)].free_model >= 0)
          for (std::size_t i = 0; i < c.error.size(); ++i)
            logs += c.share[i] * std::log(std::hypot(c.error[i], model));
        sum -= c.weight * c.independent_rows * logs;
      }
    }
    out[j] = sum;
  }
  return out;
}

void Objective::estimate_correlation(const Eigen::VectorXd& u) {
  if (!fit.estimate_correlation) return;
  const auto values = predict(u);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    auto& c = curves[k];
    const double model = model_error(c, u);
    const std::size_t n = c.measured.size();
    double square = 0, product = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto z = [&](std::size_t r) {
        return (c.measured[r] - values[k][r]) / std::hypot(c.error[r], model);
      };
      square += z(i) * z(i);
      if (i > 0) product += z(i) * z(i - 1);
    }
    const double all = effective_rows(c.share);
    c.independent_rows = all;
    const double correlation = square > 0 ? product / square : 0;
    // Less than two standard errors count as no correlation. The mean of n rows of a first-order autoregression varies
    // like that of n (1 - r) / (1 + r) independent ones.
    if (std::isfinite(correlation) && correlation > 2 / std::sqrt(double(n)))
      c.independent_rows = std::max(all * (1 - correlation) / (1 + correlation), std::min(all, 2.0));
  }
}

Eigen::VectorXd Objective::estimate_model_error(Eigen::VectorXd u) const {
  const auto values = predict(u);
  for (const auto& e : fit.errors) {
    if (e.free_model < 0) continue;
    const auto& unknown = fit.unknowns[e.free_model];
    double excess = 0, counted = 0; // variance of residuals beyond that of the measurement, over peak squared
    for (std::size_t k = 0; k < fitted_curves; ++k) {
      const auto& c = curves[k];
      if (c.measure != unknown.measure) continue;
      double mean = 0;
      for (std::size_t i = 0; i < c.measured.size(); ++i) {
        const double miss = std::isfinite(values[k][i]) ? c.measured[i] - values[k][i] : c.peak;
        mean += c.share[i] * (miss * miss - c.error[i] * c.error[i]) / (c.peak * c.peak);
      }
      excess += c.weight * c.independent_rows * mean;
      counted += c.weight * c.independent_rows;
    }
    const double size = std::sqrt(std::max(excess / std::max(counted, 1e-300), 0.0));
    u[e.free_model] = unknown.coordinate(std::clamp(size, unknown.lower * 1.01, unknown.upper * 0.99));
  }
  return u;
}

} // namespace calibration
