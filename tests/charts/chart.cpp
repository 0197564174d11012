// SPDX-License-Identifier: BSD-3-Clause
// The program of the charts: comparisons that support choices of the product and are no part of it.
#include "drivers/files/resource.hpp"
#include "tests/charts/accuracy_chart.hpp"
#include "tests/charts/cycles.hpp"
#include "tests/charts/element_chart.hpp"
#include "tests/charts/increments.hpp"
#include "tests/charts/random_states.hpp"
#include "tests/charts/stability.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <thread>

namespace {

void add_element(CLI::App& app) {
  static charts::ElementOptions options; // CLI11 writes into it
  auto* element = app.add_subcommand("element", "Integrators of the material: error, cost and failures");
  element->add_option("-o,--output", options.folder, "folder for element.csv and its pictures")
      ->capture_default_str();
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
  element->add_flag("--figures,!--no-figures", options.figures,
                    "pictures, of increments.csv beside the table too (python3-matplotlib); the default");
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

void add_accuracy(CLI::App& app) {
  static drivers::AccuracyChartOptions options;
  auto& study = options.study;
  study.data = drivers::data_folder();
  study.parallel = int(std::thread::hardware_concurrency());
  auto* accuracy = app.add_subcommand("accuracy", "Cost of a collapse against the error of its deposit");
  accuracy->add_option("-o,--output", study.folder, "folder for runs, tables and pictures")
      ->capture_default_str();
  accuracy->add_option("-j,--jobs", study.parallel, "runs at a time")->check(CLI::Range(1, 1024));
  accuracy->add_option("--data", study.data, "data folder of the project");
  accuracy->add_flag("--quick", options.quick, "a few coarse runs, to see it work");
  accuracy->add_flag("-q,--quiet", study.quiet, "no progress");
  accuracy->add_flag("--again", study.again, "run complete ones again that another build has made");
  accuracy->callback([] { drivers::chart_accuracy(options); });
}

} // namespace

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("simsand"));
  spdlog::set_pattern("%v");
  CLI::App app{"Charts of SIMSAND: what its choices rest on (tests/charts)", "simsand-chart"};
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("simsand-chart: {}; see simsand-chart --help\n", error.what());
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
    add_accuracy(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand-chart: {}\n", error.what());
    return 1;
  }
  return 0;
}
