// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/least_squares.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>
#include <numbers>
#include <numeric>

namespace calibration {
namespace {

constexpr double difference_step = 1e-3;   // of y, and of u over its range
constexpr double first_model_error = 0.05; // of the peak, where it is free
constexpr int refinements = 4;
constexpr double least_gain =
    1e-6; // of the cost, relative, by one iteration; three smaller ones end a search

struct Box {
  Eigen::VectorXd middle, half; ///< of the unknowns of the material
  Eigen::VectorXd u(const Eigen::VectorXd& full, const gsl_vector* y) const {
    Eigen::VectorXd out = full;
    for (Eigen::Index d = 0; d < middle.size(); ++d)
      out[d] = middle[d] + half[d] * std::sin(gsl_vector_get(y, d));
    return out;
  }
  /// Kept off the bounds, where the slope of the sine vanishes and a search could not leave.
  double y(double u, Eigen::Index d) const {
    return std::asin(std::clamp((u - middle[d]) / half[d], -0.998, 0.998));
  }
};

Box box_of(const Fit& fit) {
  Box box{Eigen::VectorXd(fit.parameters()), Eigen::VectorXd(fit.parameters())};
  for (int d = 0; d < fit.parameters(); ++d) {
    const auto& p = fit.unknowns[d];
    box.middle[d] = 0.5 * (p.lowest() + p.highest());
    box.half[d] = 0.5 * (p.highest() - p.lowest());
  }
  return box;
}

/// Data of GSL's callbacks.
struct Problem {
  const Objective& objective;
  Box box;
  Eigen::VectorXd full; ///< all unknowns; those that are not searched keep these values
};

int residual_callback(const gsl_vector* y, void* data, gsl_vector* f) {
  const auto& problem = *static_cast<const Problem*>(data);
  const Eigen::MatrixXd r = problem.objective.residuals(problem.box.u(problem.full, y));
  for (Eigen::Index i = 0; i < r.rows(); ++i) gsl_vector_set(f, i, r(i, 0));
  return GSL_SUCCESS;
}

int jacobian_callback(const gsl_vector* y, void* data, gsl_matrix* J) {
  const auto& problem = *static_cast<const Problem*>(data);
  const Eigen::Index d = problem.box.middle.size();
  Eigen::MatrixXd points(problem.full.size(), 2 * d);
  gsl_vector* moved = gsl_vector_alloc(d);
  for (Eigen::Index c = 0; c < 2 * d; ++c) {
    gsl_vector_memcpy(moved, y);
    gsl_vector_set(moved, c % d, gsl_vector_get(y, c % d) + (c < d ? difference_step : -difference_step));
    points.col(c) = problem.box.u(problem.full, moved);
  }
  gsl_vector_free(moved);
  const Eigen::MatrixXd r = problem.objective.residuals(points);
  for (Eigen::Index c = 0; c < d; ++c)
    for (Eigen::Index i = 0; i < r.rows(); ++i)
      gsl_matrix_set(J, i, c, (r(i, c) - r(i, c + d)) / (2 * difference_step));
  return GSL_SUCCESS;
}

LeastSquaresSearch search_from(const Objective& objective, const Eigen::VectorXd& start) {
  Problem problem{objective, box_of(objective.fit), start};
  const std::size_t d = problem.box.middle.size(), n = objective.residual_count();
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = residual_callback;
  fdf.df = jacobian_callback;
  // GSL requires at least as many rows as unknowns; those beyond the objective's are zero.
  fdf.n = std::max(n, d);
  fdf.p = d;
  fdf.params = &problem;
  auto options = gsl_multifit_nlinear_default_parameters();
  options.trs = gsl_multifit_nlinear_trs_lm;
  options.solver = gsl_multifit_nlinear_solver_svd; // for Jacobians without full rank
  gsl_multifit_nlinear_workspace* w =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &options, fdf.n, fdf.p);
  gsl_vector* y = gsl_vector_alloc(d);
  for (std::size_t k = 0; k < d; ++k) gsl_vector_set(y, k, problem.box.y(start[k], k));
  LeastSquaresSearch out;
  out.start = problem.box.u(start, y);
  gsl_multifit_nlinear_init(y, &fdf, w);
  const auto cost = [&] {
    double norm = 0;
    gsl_blas_ddot(w->f, w->f, &norm);
    return 0.5 * norm;
  };
  out.start_cost = cost();
  int reason = 0, idle = 0; // idle: iterations in a row that gained less than least_gain
  double before = out.start_cost;
  while (out.iterations < objective.fit.search.iterations && !out.converged) {
    const int status = gsl_multifit_nlinear_iterate(w);
    ++out.iterations;
    const double now = cost();
    idle = before - now < least_gain * before ? idle + 1 : 0;
    before = now;
    out.converged = status != GSL_SUCCESS || idle >= 3 ||
                    gsl_multifit_nlinear_test(1e-7, 1e-10, 0, &reason, w) == GSL_SUCCESS;
  }
  out.end = problem.box.u(start, gsl_multifit_nlinear_position(w));
  out.cost = cost();
  gsl_vector_free(y);
  gsl_multifit_nlinear_free(w);
  return out;
}

std::vector<Eigen::VectorXd> starting_points(const Objective& objective) {
  const auto& fit = objective.fit;
  const auto& options = fit.search;
  Eigen::MatrixXd points = spread_points(fit.unknowns, options.starts * options.candidates, options.seed);
  bool given = false;
  Eigen::VectorXd own = points.col(0);
  for (Eigen::Index d = 0; d < points.rows(); ++d) {
    const auto& p = fit.unknowns[d];
    if (p.property < 0) points.row(d).setConstant(p.coordinate(first_model_error));
    if (p.property < 0) own[d] = p.coordinate(first_model_error);
    given = given || p.start;
    if (p.start) own[d] = p.coordinate(*p.start);
  }
  std::vector<Eigen::VectorXd> out;
  if (given) out.push_back(own);
  std::vector<Eigen::Index> order(points.cols());
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  if (options.candidates > 1) {
    const Eigen::VectorXd costs = objective.residuals(points).colwise().squaredNorm();
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return costs[a] < costs[b]; });
  }
  for (std::size_t k = 0; out.size() < std::size_t(options.starts); ++k) out.push_back(points.col(order[k]));
  return out;
}

/// Central differences over u, one-sided at a bound.
Eigen::MatrixXd jacobian_at(const Objective& objective, const Eigen::VectorXd& u) {
  const int d = objective.fit.parameters();
  Eigen::MatrixXd points(u.size(), 2 * d);
  Eigen::VectorXd width(d);
  for (int c = 0; c < d; ++c) {
    const auto& p = objective.fit.unknowns[c];
    const double step = 0.5 * difference_step * (p.highest() - p.lowest());
    points.col(c) = points.col(c + d) = u;
    points(c, c) = std::min(u[c] + step, p.highest());
    points(c, c + d) = std::max(u[c] - step, p.lowest());
    width[c] = points(c, c) - points(c, c + d);
  }
  const Eigen::MatrixXd r = objective.residuals(points);
  return (r.leftCols(d) - r.rightCols(d)) * width.cwiseInverse().asDiagonal();
}

} // namespace

Eigen::MatrixXd spread_points(const std::vector<FreeParameter>& unknowns, int count, std::uint64_t seed) {
  const Eigen::Index d = Eigen::Index(unknowns.size());
  Eigen::MatrixXd out(d, count);
  gsl_qrng* sequence = gsl_qrng_alloc(gsl_qrng_sobol, unsigned(d));
  gsl_rng* stream = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_rng_set(stream, seed);
  Eigen::VectorXd shift(d), at(d);
  for (auto& s : shift) s = gsl_rng_uniform(stream);
  for (int k = 0; k < count; ++k) {
    gsl_qrng_get(sequence, at.data());
    for (Eigen::Index i = 0; i < d; ++i) {
      const double share = std::fmod(at[i] + shift[i], 1.0);
      out(i, k) = unknowns[i].lowest() + share * (unknowns[i].highest() - unknowns[i].lowest());
    }
  }
  gsl_qrng_free(sequence);
  gsl_rng_free(stream);
  return out;
}

BestFit least_squares(Objective& objective, const std::function<void(const std::string&)>& progress) {
  gsl_set_error_handler_off(); // return values say how a search ended
  BestFit out;
  const auto starts = starting_points(objective);
  out.searches.resize(starts.size());
  std::size_t done = 0;
  const auto report = [&](std::size_t k) {
    ++done;
    if (progress)
      progress(fmt::format("search {} of {}: half sum of squares {:.4g} -> {:.4g} in {} iterations", done,
                           starts.size(), out.searches[k].start_cost, out.searches[k].cost,
                           out.searches[k].iterations));
  };
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < starts.size(); ++k) {
    out.searches[k] = search_from(objective, starts[k]);
#pragma omp critical
    report(k);
  }
  std::stable_sort(out.searches.begin(), out.searches.end(),
                   [](const LeastSquaresSearch& a, const LeastSquaresSearch& b) { return a.cost < b.cost; });
  const LeastSquaresSearch& first = out.searches.front();
  Eigen::VectorXd u = first.end;
  for (int k = 0; k < refinements; ++k) {
    objective.set_errors(objective.predict(u));
    u = objective.estimate_model_error(u);
    objective.estimate_correlation(u);
    out.best = search_from(objective, u);
    u = out.best.end;
  }
  out.best.start = first.start;
  out.best.start_cost = first.start_cost;
  out.best.iterations += first.iterations;
  out.jacobian = jacobian_at(objective, u);
  const Eigen::VectorXd r = objective.residuals(u);
  double rows = 0;
  Eigen::Index last = 0;
  for (std::size_t k = 0; k < objective.fitted_curves; ++k) {
    const auto& c = objective.curves[k];
    rows += c.weight * c.independent_rows;
    last = Eigen::Index(c.first_row + c.measured.size());
  }
  out.chi_squared = r.head(last).squaredNorm();
  out.degrees = rows - objective.fit.parameters();
  return out;
}

} // namespace calibration
