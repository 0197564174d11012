// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/coverage.hpp"
#include "calibration/posterior.hpp"
#include "drivers/files/csv_table.hpp"
#include "drivers/files/csv_write.hpp"
#include <algorithm>
#include <exception>
#include <fmt/format.h>

namespace calibration {
namespace {

std::vector<IntervalCheck> check_set(const Fit& base, int number) {
  Fit fit = base;
  make_curves(fit, fit.synthetic->seed + std::uint64_t(number));
  Objective objective(fit);
  const auto best = least_squares(objective);
  const auto identifiability = identify(objective, best);
  auto options = *fit.sampling;
  options.seed += std::uint64_t(number);
  options.burn_in = options.coverage_burn_in;
  options.steps = options.coverage_steps;
  const auto posterior = sample_posterior(objective, best, identifiability, options);
  std::vector<IntervalCheck> out;
  for (int d = 0; d < fit.parameters(); ++d) {
    const auto& p = fit.unknowns[d];
    const auto& m = posterior.diagnosis.marginals[d];
    out.push_back({fit.synthetic->properties[p.property], m.equal_tailed.lower, m.equal_tailed.upper, m.mean,
                   p.value(best.best.end[d]), posterior.diagnosis.verdict.converged});
  }
  return out;
}

} // namespace

double Coverage::of(std::size_t parameter) const {
  double inside = 0;
  for (const auto& set : sets) inside += set[parameter].inside();
  return inside / double(sets.size());
}

double Coverage::overall() const {
  double sum = 0;
  for (std::size_t d = 0; d < names.size(); ++d) sum += of(d);
  return sum / double(names.size());
}

Coverage study_coverage(const Fit& fit, int sets, const Coverage& earlier,
                        const std::function<void(const Coverage&, int)>& progress) {
  Coverage out;
  for (int d = 0; d < fit.parameters(); ++d) out.names.push_back(fit.unknowns[d].name);
  out.sets = earlier.sets;
  out.sets.resize(sets);
  int done = int(std::count_if(out.sets.begin(), out.sets.end(), [](const auto& s) { return !s.empty(); }));
  std::exception_ptr error;
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < sets; ++k) {
    if (k < int(earlier.sets.size()) && !earlier.sets[k].empty()) continue;
    std::vector<IntervalCheck> set;
    std::exception_ptr failed;
    try {
      set = check_set(fit, k + 1);
    } catch (...) {
      failed = std::current_exception();
    }
#pragma omp critical
    try {
      if (failed) std::rethrow_exception(failed);
      out.sets[k] = std::move(set);
      ++done;
      if (progress) progress(out, done);
    } catch (...) {
      error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
  return out;
}

namespace {

/// Hash of the fit's options, by which a resumed study recognises its file.
std::uint32_t hash_of(const Fit& fit) {
  std::uint32_t hash = 2166136261u; // FNV-1a
  for (const char c : fit.resolved) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

} // namespace

std::string coverage_csv(const Fit& fit, const Coverage& coverage) {
  drivers::CsvWriter csv("data_set,parameter,truth,lower_90,upper_90,mean,best,converged,inside",
                         {fmt::format("fit: {}", hash_of(fit))});
  const auto number = [](double value) { return drivers::Rounded{value, 8}; };
  for (std::size_t k = 0; k < coverage.sets.size(); ++k)
    for (std::size_t d = 0; d < coverage.sets[k].size(); ++d) {
      const auto& c = coverage.sets[k][d];
      csv.row(k + 1, coverage.names[d], number(c.truth), number(c.lower), number(c.upper), number(c.mean),
              number(c.best), c.converged, c.inside());
    }
  return csv.text();
}

Coverage read_coverage(const Fit& fit, const std::string& file) {
  const drivers::CsvTable csv(file);
  if (csv.note("fit") != double(hash_of(fit)))
    throw std::runtime_error(file + ": belongs to another fit, or to other options");
  const auto number = csv.numbers("data_set"), truth = csv.numbers("truth"), lower = csv.numbers("lower_90"),
             upper = csv.numbers("upper_90"), mean = csv.numbers("mean"), best = csv.numbers("best"),
             converged = csv.numbers("converged");
  Coverage out;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    const auto set = std::size_t(number[i]) - 1;
    out.sets.resize(std::max(out.sets.size(), set + 1));
    out.sets[set].push_back({truth[i], lower[i], upper[i], mean[i], best[i], converged[i] == 1});
  }
  return out;
}

std::string coverage_text(const Coverage& coverage) {
  const auto converged = std::count_if(coverage.sets.begin(), coverage.sets.end(),
                                       [](const auto& set) { return set.front().converged; });
  std::string out = fmt::format("{} data sets, {} with converged chains; truth inside the 90 % interval:\n",
                                coverage.sets.size(), converged);
  for (std::size_t d = 0; d < coverage.names.size(); ++d)
    out += fmt::format("{:<10}{:>8.1f} %\n", coverage.names[d], 100 * coverage.of(d));
  return out + fmt::format("{:<10}{:>8.1f} %\n", "all", 100 * coverage.overall());
}

} // namespace calibration
