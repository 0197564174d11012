// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/posterior.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>
#include <memory>

namespace calibration {
namespace {

using Stream = std::unique_ptr<gsl_rng, void (*)(gsl_rng*)>;

Stream new_stream(std::uint64_t seed) {
  Stream s(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(s.get(), seed);
  return s;
}

/// Points about the best fit, within the bounds: normal with three times the standard deviations of its covariance, and
/// with a deviation of 0.7 in the logarithm of model errors.
Eigen::MatrixXd first_points(const Objective& objective, const BestFit& best,
                             const Identifiability& identifiability, const SamplingOptions& options) {
  const auto& unknowns = objective.fit.unknowns;
  const Eigen::Index all = Eigen::Index(unknowns.size()), d = objective.fit.parameters();
  const int count = std::max(2 * options.walkers, int(10 * all));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(identifiability.covariance);
  const Eigen::MatrixXd root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  auto stream = new_stream(options.seed + 7919);
  Eigen::MatrixXd points(all, count);
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd normal(all);
    for (auto& x : normal) x = gsl_ran_gaussian(stream.get(), 1);
    Eigen::VectorXd u = best.best.end;
    u.head(d) += 3 * root * normal.head(d);
    u.tail(all - d) += 0.7 * normal.tail(all - d);
    for (Eigen::Index i = 0; i < all;
         ++i) { // reflected at the bounds; if that does not help, uniform within them
      const double low = unknowns[i].lowest(), high = unknowns[i].highest();
      if (u[i] < low) u[i] = 2 * low - u[i];
      if (u[i] > high) u[i] = 2 * high - u[i];
      if (!(u[i] > low && u[i] < high)) u[i] = low + (high - low) * gsl_rng_uniform_pos(stream.get());
    }
    points.col(k) = u;
  }
  return points;
}

/// FNV-1a.
void add(std::uint64_t& hash, const void* bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ull;
}
void add(std::uint64_t& hash, double value) {
  add(hash, &value, sizeof value);
}
void add(std::uint64_t& hash, const std::vector<double>& values) {
  add(hash, values.data(), values.size() * sizeof(double));
}

/// Adds the quantiles of one row: of the model's values at the samples drawn, and of these with errors added.
void add_row(Band& band, std::vector<double>& model, std::vector<double>& measured) {
  const auto at = [](std::vector<double>& v, double q) {
    return gsl_stats_quantile_from_sorted_data(v.data(), 1, v.size(), q);
  };
  std::sort(model.begin(), model.end());
  std::sort(measured.begin(), measured.end());
  band.model_lower.push_back(at(model, 0.05));
  band.model_median.push_back(at(model, 0.5));
  band.model_upper.push_back(at(model, 0.95));
  band.lower.push_back(at(measured, 0.05));
  band.upper.push_back(at(measured, 0.95));
}

} // namespace

std::string fingerprint(const Objective& objective) {
  std::uint64_t hash = 14695981039346656037ull;
  const auto& fit = objective.fit;
  add(hash, fit.material.material.properties);
  for (const auto& p : fit.unknowns) {
    add(hash, p.name.data(), p.name.size());
    for (double v : {p.lower, p.upper, double(p.logarithmic), double(int(p.prior.kind)), p.prior.centre,
                     p.prior.deviation})
      add(hash, v);
  }
  for (std::size_t k = 0; k < objective.fitted_curves; ++k) {
    const auto& c = objective.curves[k];
    const auto& s = fit.tests[c.test].specimen;
    add(hash, s.kind->name.data(), s.kind->name.size());
    for (double v : {s.void_ratio, s.axial_stress, s.radial_stress, double(int(c.measure)), c.peak,
                     c.independent_rows, c.weight})
      add(hash, v);
    for (const auto* v : {&fit.tests[c.test].strain, &c.measured, &c.share, &c.error}) add(hash, *v);
  }
  return fmt::format("{:016x}", hash);
}

Posterior sample_posterior(const Objective& objective, const BestFit& best,
                           const Identifiability& identifiability, const SamplingOptions& options,
                           const ChainRun& run) {
  const auto& unknowns = objective.fit.unknowns;
  SamplerOptions sampler;
  sampler.walkers = options.walkers;
  sampler.burn_in = options.burn_in;
  sampler.steps = options.steps;
  sampler.thinning = options.thinning;
  sampler.seed = options.seed;
  sampler.lower.resize(Eigen::Index(unknowns.size()));
  sampler.upper = sampler.lower;
  Posterior out;
  for (std::size_t d = 0; d < unknowns.size(); ++d) {
    sampler.lower[Eigen::Index(d)] = unknowns[d].lowest();
    sampler.upper[Eigen::Index(d)] = unknowns[d].highest();
    out.names.push_back(unknowns[d].name);
  }
  Checkpoint checkpoint;
  checkpoint.file = run.file;
  checkpoint.names = out.names;
  checkpoint.fingerprint = fingerprint(objective);
  checkpoint.resume = run.resume;
  out.chain =
      sample([&](const auto& points) { return objective.log_posterior(points); },
             first_points(objective, best, identifiability, options), sampler, checkpoint, run.progress);
  Chain values = out.chain; // values in place of coordinates, which the diagnosis refers to
  const std::size_t d = unknowns.size();
  for (std::size_t i = 0; i < values.samples.size(); ++i)
    values.samples[i] = unknowns[i % d].value(values.samples[i]);
  out.values = values.pooled();
  if (values.steps >= 8) out.diagnosis = diagnose(values, out.names);
  return out;
}

void predict_bands(const Objective& objective, const SamplingOptions& options, Posterior& posterior) {
  const auto samples = posterior.chain.pooled();
  const Eigen::Index sets = std::min<Eigen::Index>(options.predictive_sets, samples.cols());
  std::vector<std::vector<std::vector<double>>> drawn(sets); // set, curve, row
#pragma omp parallel for schedule(dynamic)
  for (Eigen::Index s = 0; s < sets; ++s)
    drawn[s] = objective.predict(samples.col(s * samples.cols() / sets));
  std::vector<bool> complete(sets, true);
  for (Eigen::Index s = 0; s < sets; ++s)
    for (const auto& curve : drawn[s])
      if (std::any_of(curve.begin(), curve.end(), [](double v) { return !std::isfinite(v); }))
        complete[s] = false;
  posterior.incomplete = std::size_t(std::count(complete.begin(), complete.end(), false));
  posterior.bands.assign(objective.curves.size(), {});
  if (posterior.incomplete + 2 > std::size_t(sets)) return;
  auto stream = new_stream(options.seed + 104729);
  for (std::size_t k = 0; k < objective.curves.size(); ++k) {
    const auto& c = objective.curves[k];
    auto& band = posterior.bands[k];
    std::size_t inside = 0;
    for (std::size_t i = 0; i < c.measured.size(); ++i) {
      std::vector<double> model, measured;
      for (Eigen::Index s = 0; s < sets; ++s) {
        if (!complete[s]) continue;
        const double error =
            std::hypot(c.error[i], objective.model_error(c, samples.col(s * samples.cols() / sets)));
        model.push_back(drawn[s][k][i]);
        measured.push_back(model.back() + gsl_ran_gaussian(stream.get(), error));
      }
      add_row(band, model, measured);
      inside += c.measured[i] >= band.lower.back() && c.measured[i] <= band.upper.back();
    }
    band.coverage = double(inside) / double(c.measured.size());
  }
}

} // namespace calibration
