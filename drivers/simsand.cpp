// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include "drivers/element.hpp"
#include "drivers/run.hpp"
#include "drivers/scene_file.hpp"
#include "drivers/version.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

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

} // namespace

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("simsand"));
  spdlog::set_pattern("%v");
  CLI::App app{"SIMSAND sand: column collapse by smoothed particle hydrodynamics, and element tests",
               "simsand"};
  app.set_version_flag("--version", drivers::version);
  app.require_subcommand(1);
  try {
    add_run(app);
    add_element(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand: {}\n", error.what());
    return 1;
  }
  return 0;
}
