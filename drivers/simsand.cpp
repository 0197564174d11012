// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include "drivers/abaqus_deck.hpp"
#include "drivers/element.hpp"
#include "drivers/run.hpp"
#include "drivers/scene_file.hpp"
#include "drivers/version.hpp"
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace {

void add_run(CLI::App& app) {
  static std::string file, folder; // live as long as the program: CLI11 writes into them
  static int threads = 0;
  static drivers::RunOptions options;
  auto* run = app.add_subcommand("run", "Run a scene: a column collapses and comes to rest");
  run->add_option("SCENE", file, "scene file (.toml), or a result file (.h5) whose stored scene is run again")
      ->required();
  run->add_option("-o,--output", folder, "folder for the results, instead of the scene's output.folder");
  run->add_option("-t,--threads", threads, "threads; results do not depend on their number")
      ->check(CLI::Range(1, 1024));
  run->add_flag("-q,--quiet", options.quiet, "no progress");
  run->callback([] {
    if (threads > 0) omp_set_num_threads(threads);
    auto scene = drivers::read_scene(file);
    if (!folder.empty()) scene.output_folder = folder;
    drivers::run_scene(scene, options);
  });
}

void add_element(CLI::App& app) {
  static drivers::ElementOptions options;
  auto* element = app.add_subcommand("element", "Lead one material point along a path of stress and strain");
  element->add_option("PATH", options.path_file, "path file (.toml); vocabulary: drivers/ELEMENT.md")
      ->required();
  element->add_option("-o,--output", options.output, "table (.csv); default: standard output");
  element->add_option("--resolved", options.resolved, "file for the path with every key written out");
  element->callback([] {
    if (drivers::run_element(options) != 0) throw CLI::RuntimeError(1);
  });
}

void add_abaqus(CLI::App& app) {
  static std::string file;
  static drivers::AbaqusOptions options;
  auto* abaqus = app.add_subcommand("abaqus", "Write an ABAQUS/Explicit deck of a scene");
  abaqus->add_option("SCENE", file, "scene file (.toml), or a result file (.h5); manual: drivers/ABAQUS.md")
      ->required();
  abaqus->add_option("-o,--output", options.folder, "folder for the deck, the subroutine and a page")
      ->required();
  abaqus->add_option("--spacing", options.spacing,
                     "distance of particles, m: the scene's (default) or coarser");
  abaqus->callback([] {
    const auto summary = drivers::write_abaqus(drivers::read_scene(file), options);
    for (const auto& remark : summary.remarks) spdlog::warn("{}", remark);
    fmt::print("{} particles of {:.4g} mm: {}, {}\n", summary.particles, 1e3 * summary.edge, summary.deck,
               summary.page);
  });
}

/// Threads that wait at the end of a stage sleep. By default they spin, and where another program needs
/// the same cores a run on two threads then takes ten times as long. OpenMP reads its settings before
/// main, so the program starts anew with this one, unless the user has chosen.
void wait_passively(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY")) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv); // returns only if it fails: then go on as we are
}

} // namespace

int main(int argc, char** argv) {
  wait_passively(argv);
  spdlog::set_default_logger(spdlog::stderr_color_mt("simsand"));
  spdlog::set_pattern("%v");
  CLI::App app{"SIMSAND sand: column collapse by smoothed particle hydrodynamics, and element tests",
               "simsand"};
  app.set_version_flag("--version", drivers::version);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("simsand: {}; see simsand --help\n", error.what());
  });
  try {
    add_run(app);
    add_element(app);
    add_abaqus(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand: {}\n", error.what());
    return 1;
  }
  return 0;
}
