// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/report.hpp"
#include "host/files/whole_file.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace calibration {
namespace {

/// Root mean square of the residuals, in standard deviations, above which the report warns of a curve.
constexpr double largest_misfit = 1.5;
/// Searches count as ending at the best optimum within these of the lowest half sum of squares, relative and absolute.
constexpr double same_cost_relative = 1e-3, same_cost = 0.01;

/// For instance "0.80 e_ref - 0.60 n_p"; weights below 0.15 are left out.
std::string combination_text(const Combination& c, const std::vector<FreeParameter>& unknowns) {
  std::string out;
  for (Eigen::Index d = 0; d < c.weights.size(); ++d) {
    const double w = c.weights[d];
    if (std::abs(w) < 0.15) continue;
    out += out.empty() ? (w < 0 ? "-" : "") : (w < 0 ? " - " : " + ");
    out += fmt::format("{:.2f} {}", std::abs(w), (unknowns[d].logarithmic ? "ln " : "") + unknowns[d].name);
  }
  return out;
}

/// Interval of 90 % of a normal distribution of the coordinate, cut off at the bounds, as values.
std::string linear_interval(const FreeParameter& p, double u, double deviation) {
  return fmt::format("{:.4g} to {:.4g}", p.value(std::max(u - 1.645 * deviation, p.lowest())),
                     p.value(std::min(u + 1.645 * deviation, p.highest())));
}

/// Number of searches that end at the best optimum.
long searches_at_best(const BestFit& fit) {
  const double least = fit.searches.front().cost;
  return std::count_if(fit.searches.begin(), fit.searches.end(), [&](const LeastSquaresSearch& s) {
    return s.cost <= least * (1 + same_cost_relative) + same_cost;
  });
}

std::string parameter_lines(const Result& r) {
  const auto& fit = r.objective.fit;
  std::string out = fmt::format("{:<10}{:>12}{:>24}{:>14}{:>12}{:>14}  {}\n", "parameter", "best",
                                "linear 90 %", "start", "material", "sd / range", "");
  for (int d = 0; d < fit.parameters(); ++d) {
    const auto& p = fit.unknowns[d];
    const double u = r.fit.best.end[d], sd = std::sqrt(r.identifiability.covariance(d, d));
    out += fmt::format("{:<10}{:>12.5g}{:>24}{:>14.4g}{:>12.4g}{:>14.2g}  {}\n", p.name, p.value(u),
                       linear_interval(p, u, sd), p.value(r.fit.best.start[d]),
                       fit.material.material.properties[p.property], r.identifiability.deviation[d],
                       describe(r.identifiability.findings[d]));
  }
  for (std::size_t d = fit.parameters(); d < fit.unknowns.size(); ++d)
    out += fmt::format("{:<32}{:.3g} of the peak\n", fit.unknowns[d].name,
                       fit.unknowns[d].value(r.fit.best.end[d]));
  return out;
}

std::string posterior_lines(const Result& r) {
  const auto& post = *r.posterior;
  std::string out = fmt::format("\nPosterior: {} walkers, {} steps kept of each, acceptance {:.2f}; "
                                "{}\n{:<28}{:>10}{:>10}{:>24}{:>8}{:>8}{:>8}\n",
                                post.chain.walkers, post.chain.steps, post.chain.acceptance,
                                post.diagnosis.verdict.converged ? "converged" : "NOT CONVERGED", "", "mean",
                                "sd", "90 % interval", "R-hat", "ESS", "tail");
  for (std::size_t d = 0; d < post.diagnosis.marginals.size(); ++d) {
    const auto& m = post.diagnosis.marginals[d];
    out +=
        fmt::format("{:<28}{:>10.4g}{:>10.2g}{:>24}{:>8.3f}{:>8.0f}{:>8.0f}\n", post.names[d], m.mean,
                    m.deviation, fmt::format("{:.4g} to {:.4g}", m.equal_tailed.lower, m.equal_tailed.upper),
                    m.rhat, m.bulk_size, m.tail_size);
  }
  for (const auto& reason : post.diagnosis.verdict.reasons) out += "  " + reason + "\n";
  return out;
}

std::string curve_lines(const Result& r) {
  std::string out = fmt::format("\n{:<24}{:<20}{:>6}{:>8}{:>12}{:>10}{:>14}{:>10}{:>14}\n", "test", "curve",
                                "rows", "counted", "rms", "of peak", "material's", "/ error", "in 90 % band");
  const auto all = misfits(r.objective, r.fit.best.end), material = misfits(r.objective, at_material(r));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& c = r.objective.curves[k];
    const bool band = r.posterior && !r.posterior->bands.empty() && !r.posterior->bands[k].lower.empty();
    out += fmt::format("{:<24}{:<20}{:>6}{:>8.0f}{:>12.3g}{:>10.3g}{:>14.3g}{:>10.2f}{:>14}{}\n",
                       r.objective.fit.tests[c.test].name, info(c.measure).key, c.measured.size(),
                       c.independent_rows, all[k].rms, all[k].of_peak, material[k].of_peak, all[k].in_errors,
                       band ? fmt::format("{:.0f} %", 100 * r.posterior->bands[k].coverage) : "",
                       k >= r.objective.fitted_curves ? "  held out" : "");
  }
  return out;
}

} // namespace

std::vector<CurveMisfit> misfits(const Objective& objective, const Eigen::VectorXd& u) {
  const auto values = objective.predict(u);
  std::vector<CurveMisfit> out;
  for (std::size_t k = 0; k < objective.curves.size(); ++k) {
    const auto& c = objective.curves[k];
    double square = 0, scaled = 0;
    for (std::size_t i = 0; i < c.measured.size(); ++i) {
      const double error = std::hypot(c.error[i], objective.model_error(c, u));
      const double miss =
          std::isfinite(values[k][i]) ? c.measured[i] - values[k][i] : failed_residual * error;
      square += c.share[i] * miss * miss;
      scaled += c.share[i] * miss * miss / (error * error);
    }
    out.push_back({std::sqrt(square), std::sqrt(square) / c.peak, std::sqrt(scaled)});
  }
  return out;
}

Eigen::VectorXd at_material(const Result& r) {
  const auto& fit = r.objective.fit;
  Eigen::VectorXd u = r.fit.best.end;
  for (int d = 0; d < fit.parameters(); ++d)
    u[d] = fit.unknowns[d].coordinate(
        std::max(fit.material.material.properties[fit.unknowns[d].property], 1e-300));
  return u;
}

std::vector<std::string> warnings(const Result& r) {
  std::vector<std::string> out;
  const auto& fit = r.objective.fit;
  for (int d = 0; d < fit.parameters(); ++d)
    if (r.identifiability.findings[d] != Finding::determined)
      out.push_back(fmt::format("{} is {}", fit.unknowns[d].name, describe(r.identifiability.findings[d])));
  for (const auto& c : r.identifiability.combinations)
    if (!c.determined) out.push_back("these tests do not determine " + combination_text(c, fit.unknowns));
  if (r.fit.degrees <= 0)
    out.push_back(
        fmt::format("{} parameters from no more independent values: the misfit says nothing about the errors",
                    fit.parameters()));
  const auto all = misfits(r.objective, r.fit.best.end);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].in_errors > largest_misfit)
      out.push_back(fmt::format("residuals of {} of '{}' are {:.1f} times the errors stated{}",
                                info(r.objective.curves[k].measure).key,
                                fit.tests[r.objective.curves[k].test].name, all[k].in_errors,
                                k >= r.objective.fitted_curves ? " (held out)" : ""));
  const auto same = searches_at_best(r.fit);
  if (r.fit.searches.size() > 1 && same < 2)
    out.push_back(
        fmt::format("only 1 of {} searches ended at the best optimum: more starts may find a better one",
                    r.fit.searches.size()));
  if (!r.fit.best.converged)
    out.push_back("the last search stopped before it converged: more iterations may help");
  if (r.posterior && !r.posterior->diagnosis.verdict.converged)
    out.push_back("the chains have not converged: their intervals are provisional");
  return out;
}

std::string report_text(const Result& r) {
  const auto& fit = r.objective.fit;
  std::string out = fmt::format("{}\n{}\n\n", fit.title.empty() ? fit.file_name : fit.title, r.command);
  out += parameter_lines(r);
  const auto same = searches_at_best(r.fit);
  out += fmt::format("\nChi squared {:.4g} for {:.0f} degrees of freedom", r.fit.chi_squared, r.fit.degrees);
  out += r.identifiability.inflation > 1
             ? fmt::format("; linear intervals widened by sqrt({:.3g})\n", r.identifiability.inflation)
             : "\n";
  out += fmt::format(
      "{} of {} searches end at the best; {} simulations of all tests, {} with a failed test; {:.1f} s\n",
      same, r.fit.searches.size(), r.objective.simulations(), r.objective.failures(), r.seconds);
  if (r.posterior) out += posterior_lines(r);
  out += curve_lines(r);
  out += "\nCombinations of parameters (over their ranges), best determined first\n";
  for (const auto& c : r.identifiability.combinations)
    out += fmt::format("{:>12.3g}  sd {:<10.2g}{}{}\n", c.singular_value, c.deviation,
                       combination_text(c, fit.unknowns), c.determined ? "" : "  NOT DETERMINED");
  out += "\nCorrelation\n";
  for (int i = 0; i < fit.parameters(); ++i) {
    out += fmt::format("{:<10}", fit.unknowns[i].name);
    for (int j = 0; j <= i; ++j) out += fmt::format("{:>8.2f}", r.identifiability.correlation(i, j));
    out += "\n";
  }
  out += "\nSearches: half sum of squares at start and end, iterations, parameters\n";
  for (const auto& s : r.fit.searches) {
    out += fmt::format("{:>12.4g}{:>12.4g}{:>6}{}", s.start_cost, s.cost, s.iterations,
                       s.converged ? "  " : " *");
    for (int d = 0; d < fit.parameters(); ++d)
      out += fmt::format(" {} {:.4g} -> {:.4g};", fit.unknowns[d].name, fit.unknowns[d].value(s.start[d]),
                         fit.unknowns[d].value(s.end[d]));
    out += "\n";
  }
  const auto list = warnings(r);
  out += list.empty() ? "\nNo warnings.\n" : "\nWARNINGS\n";
  for (const auto& line : list) out += "- " + line + "\n";
  return out;
}

std::vector<std::string> write_report(const Result& r) {
  namespace fs = std::filesystem;
  const fs::path folder = r.objective.fit.output_folder;
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    host::write_whole(folder / name, text);
    files.push_back((folder / name).string());
  };
  write("report.txt", report_text(r));
  write("report.toml", report_toml(r));
  write(r.objective.fit.material_name, material_toml(r));
  const auto h5 = folder / "fit.h5";
  write_hdf5(r, h5);
  files.push_back(h5.string());
  return files;
}

} // namespace calibration
