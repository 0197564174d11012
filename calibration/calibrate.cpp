// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibrate.hpp"
#include "calibration/coverage.hpp"
#include "calibration/report.hpp"
#include "host/files/whole_file.hpp"
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace calibration {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be created ({})", folder, error.message()));
}

void run_coverage(const Fit& fit, const CalibrateOptions& options) {
  if (!fit.synthetic || !fit.sampling || !(fit.synthetic->noise > 0))
    throw std::runtime_error(fmt::format(
        "{}: --coverage needs the tables [synthetic], with noise above 0, and [sampling]", fit.file_name));
  const auto start = Clock::now();
  const auto file = (std::filesystem::path(fit.output_folder) / "coverage.csv").string();
  const auto earlier =
      options.resume && std::filesystem::exists(file) ? read_coverage(fit, file) : Coverage{};
  int before = -1; // number of sets taken from the file
  const auto coverage = study_coverage(fit, options.coverage, earlier, [&](const Coverage& now, int done) {
    if (before < 0) before = done - 1;
    host::write_whole(file, coverage_csv(fit, now));
    const double elapsed = seconds_since(start);
    if (!options.quiet)
      spdlog::info("{} of {} data sets, {:.0f} s, {:.0f} s left", done, options.coverage, elapsed,
                   elapsed / (done - before) * (options.coverage - done));
  });
  fmt::print("{}{:.0f} s; intervals: {}\n", coverage_text(coverage), seconds_since(start), file);
}

ProgressReport progress_line(bool quiet) {
  return [quiet, last = Clock::now()](const SamplerProgress& p) mutable {
    if (!quiet && (seconds_since(last) > 5 || p.fraction >= 1)) {
      last = Clock::now();
      spdlog::info("sampling{}: {:.0f} %, acceptance {:.2f}, {:.0f} s left", p.burning_in ? " (burn-in)" : "",
                   100 * p.fraction, p.acceptance, p.seconds_left);
    }
    return true;
  };
}

} // namespace

void calibrate(const CalibrateOptions& options) {
  const auto start = Clock::now();
  Fit fit = read_fit(options.fit_file);
  if (!options.folder.empty()) fit.output_folder = options.folder;
  make_folder(fit.output_folder);
  if (options.coverage > 0) return run_coverage(fit, options);
  Objective objective(fit);
  const auto best = least_squares(objective, [&](const std::string& line) {
    if (!options.quiet) spdlog::info("{}", line);
  });
  const auto identifiability = identify(objective, best);
  std::optional<Posterior> posterior;
  if (fit.sampling && !options.best_only) {
    const auto file = (std::filesystem::path(fit.output_folder) / "chain.h5").string();
    if (!options.resume) std::filesystem::remove(file); // a new run replaces the results of an older one
    posterior = sample_posterior(objective, best, identifiability, *fit.sampling,
                                 {file, options.resume, progress_line(options.quiet)});
    predict_bands(objective, *fit.sampling, *posterior);
  }
  const Result result{objective,       best,
                      identifiability, posterior ? &*posterior : nullptr,
                      options.command, seconds_since(start)};
  const auto files = write_report(result);
  fmt::print("{}\n", report_text(result));
  for (const auto& file : files) fmt::print("{}\n", file);
}

} // namespace calibration
