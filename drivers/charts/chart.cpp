// SPDX-License-Identifier: BSD-3-Clause
// The program of the charts: comparisons that support choices of the product and are no part of it.
#include "drivers/charts/cycles.hpp"
#include "drivers/charts/element_chart.hpp"
#include "drivers/charts/increments.hpp"
#include "drivers/charts/random_states.hpp"
#include "drivers/charts/stability.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace {

void add_element(CLI::App& app) {
  static charts::ElementOptions options; // CLI11 writes into it
  auto* element = app.add_subcommand("element", "Integrators of the material: error, cost and failures");
  element->add_option("-o,--output", options.folder, "folder for element.csv")->capture_default_str();
  element->add_option("--states", options.states,
                      "updates sampled from a run (states.csv of `chart increments`)");
  element->add_option("--increments", options.increments, "sizes of the strain increments")
      ->check(CLI::Range(1e-9, 0.1));
  element->add_option("--pressures", options.choice.pressures, "mean stresses at the start, Pa")
      ->check(CLI::Range(1e-3, 1e8));
  element->add_option("--stages", options.choice.stages, "shares of the strength mobilised at the start")
      ->check(CLI::Range(0., 0.9999));
  element->add_option("--repetitions", options.repetitions, "of each measurement of cost; the least counts")
      ->check(CLI::Range(1, 100));
  element->callback([] { charts::chart_element(options); });
}

void add_increments(CLI::App& app) {
  static charts::IncrementOptions options;
  auto* increments = app.add_subcommand("increments", "Strain increments that a run gives to its material");
  increments->add_option("SCENE", options.scene, "scene file (.toml) or result (.h5)")->required();
  increments->add_option("-o,--output", options.folder, "folder for the tables")->capture_default_str();
  increments->add_option("--samples", options.samples, "updates of the collapse that are kept")
      ->check(CLI::Range(1, 1000000));
  increments->add_option("--end-time", options.end_time, "s, instead of the scene's");
  increments->callback([] { charts::chart_increments(options); });
}

void add_random(CLI::App& app) {
  static charts::RandomOptions options;
  auto* random =
      app.add_subcommand("random", "Random states and increments; fails if an answer may not stand");
  random->add_option("-n,--count", options.count, "updates")
      ->check(CLI::Range(1., 1e12))
      ->capture_default_str();
  random
      ->add_option("--first-block", options.first_block, "first block of 128, to go on after an earlier run")
      ->check(CLI::NonNegativeNumber);
  random->add_option("--seed", options.seed, "of the random numbers");
  random->add_option("--compared", options.compared, "share that is compared with the reference")
      ->check(CLI::Range(0., 1.))
      ->capture_default_str();
  random->add_flag("--single", options.single, "the library of single precision");
  random->add_option("--library", options.library, "another build of the material");
  random->add_flag("-q,--quiet", options.quiet, "no progress");
  random->callback([] {
    if (!charts::chart_random(options)) throw CLI::RuntimeError(1);
  });
}

void add_cycles(CLI::App& app) {
  static charts::CycleOptions options;
  auto* cycles =
      app.add_subcommand("cycles", "Energy of closed cycles of strain; fails if a cycle gives some away");
  cycles->add_option("-n,--count", options.count, "random cycles of each amplitude")
      ->check(CLI::Range(1, 10000000));
  cycles->add_option("--parts", options.parts, "increments per side")->check(CLI::Range(2, 100000));
  cycles->add_option("-o,--output", options.output, "table of the cycles (.csv)");
  cycles->callback([] {
    if (!charts::chart_cycles(options)) throw CLI::RuntimeError(1);
  });
}

void add_stability(CLI::App& app) {
  static charts::StabilityOptions options;
  auto* stability =
      app.add_subcommand("stability", "Where the particle scheme holds, over its numerical choices");
  stability
      ->add_option("-o,--output", options.folder, "folder for stability.csv; what it holds is not run again")
      ->capture_default_str();
  stability->add_flag("--quick", options.quick, "a small grid");
  stability->add_flag("--afresh", options.afresh, "run all again");
  stability->callback([] { charts::chart_stability(options); });
}

} // namespace

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("simsand"));
  spdlog::set_pattern("%v");
  CLI::App app{"Charts of SIMSAND: what its choices rest on (drivers/charts/INTEGRATORS.md)",
               "simsand chart"};
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("simsand chart: {}; see simsand chart --help\n", error.what());
  });
  int threads = 0;
  app.add_option("-t,--threads", threads, "threads; numbers do not depend on them")
      ->check(CLI::Range(1, 1024))
      ->each([](const std::string& count) { omp_set_num_threads(std::stoi(count)); });
  try {
    add_element(app);
    add_increments(app);
    add_random(app);
    add_cycles(app);
    add_stability(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand chart: {}\n", error.what());
    return 1;
  }
  return 0;
}
