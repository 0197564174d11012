// SPDX-License-Identifier: BSD-3-Clause
// `simsand run --posterior`: a scene with sets of parameters drawn from a calibration.
#include "calibration/propagate.hpp"
#include "drivers/commands/run.hpp"
#include "drivers/files/resource.hpp"
#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

namespace commands {

RunKind add_posterior(CLI::App& run) {
  const auto options = std::make_shared<calibration::PropagateOptions>();
  options->study.parallel = int(std::thread::hardware_concurrency());
  auto* chosen =
      run.add_option("--posterior", options->posterior,
                     "fit.h5 of simsand calibrate: runs the scene for sets of parameters drawn from it");
  run.add_option("-n,--sets", options->sets, "sets drawn")->check(CLI::Range(2, 100000))->needs(chosen);
  run.add_option("--seed", options->seed, "of the draw")->needs(chosen);
  run.add_option("-j,--jobs", options->study.parallel, "sets at a time")
      ->check(CLI::Range(1, 1024))
      ->needs(chosen);
  return {chosen, [options](const RunRequest& request) {
            options->scene = request.scene;
            options->settings = request.settings;
            options->study.folder = request.folder;
            options->study.data = drivers::data_folder();
            options->study.quiet = request.quiet;
            calibration::propagate(*options);
          }};
}

} // namespace commands
