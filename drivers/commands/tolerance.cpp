// SPDX-License-Identifier: BSD-3-Clause
// `simsand run --tolerance`: resolution and scheme are chosen for a wanted accuracy.
#include "drivers/commands/run.hpp"
#include "drivers/files/resource.hpp"
#include "drivers/run/interrupt.hpp"
#include "drivers/tolerance/tolerance_run.hpp"
#include <CLI/CLI.hpp>
#include <memory>

namespace commands {

RunKind add_tolerance(CLI::App& run) {
  const auto options = std::make_shared<drivers::ToleranceOptions>();
  auto* chosen = run.add_option_function<std::string>(
      "--tolerance",
      [options](const std::string& text) { options->tolerance = drivers::read_tolerance(text); },
      "as 5%: chooses resolution, geometry, material, stiffness scale and precision for "
      "h_f and r_f within it, and estimates their error (tests/charts/ACCURACY.md)");
  run.add_option("--data", options->data,
                 "data folder, with the chart of --tolerance; default: that of the program");
  return {chosen, [options](const RunRequest& request) {
            drivers::listen_for_signals();
            if (options->data.empty()) options->data = drivers::data_folder();
            options->scene = request.scene;
            options->settings = request.settings;
            options->folder = request.folder;
            drivers::run_to_tolerance(*options, {request.quiet});
          }};
}

} // namespace commands
