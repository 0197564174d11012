// SPDX-License-Identifier: BSD-3-Clause
// `simsand calibrate`: laboratory tests in, parameters out.
#include "calibration/calibrate.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <omp.h>

namespace commands {
namespace {

struct Options {
  calibration::CalibrateOptions fit;
  int threads = 0;
};

} // namespace

void add_calibrate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto& fit = options->fit;
  auto* command = app.add_subcommand("calibrate", "Fit parameters to laboratory tests");
  command->add_option("FIT", fit.fit_file, "fit file (.toml); manual: calibration/README.md")->required();
  command->add_option("-o,--output", fit.folder,
                      "folder for the results, instead of the fit's output.folder");
  command->add_option("-t,--threads", options->threads, "threads; results do not depend on their number")
      ->check(CLI::Range(1, 1024));
  command->add_flag("-q,--quiet", fit.quiet, "no progress");
  command->add_flag("--resume", fit.resume, "go on with an interrupted run");
  command->add_flag("--best-only", fit.best_only, "least squares alone, no sampling");
  command
      ->add_option("--coverage", fit.coverage,
                   "fit so many synthetic data sets and count the intervals that hold the truth")
      ->check(CLI::Range(1, 100000));
  command->callback([options] {
    auto& fit = options->fit;
    if (options->threads > 0) omp_set_num_threads(options->threads);
    fit.command = fmt::format("simsand calibrate {}{}", fit.fit_file, fit.best_only ? " --best-only" : "");
    calibration::calibrate(fit);
  });
}

} // namespace commands
