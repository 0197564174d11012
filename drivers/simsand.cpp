// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#include "calibration/calibrate.hpp"
#include "calibration/propagate.hpp"
#include "drivers/abaqus/deck.hpp"
#include "drivers/commands/compile.hpp"
#include "drivers/element/command.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/run/info.hpp"
#include "drivers/run/interrupt.hpp"
#include "drivers/run/plan.hpp"
#include "drivers/run/resume.hpp"
#include "drivers/run/run.hpp"
#include "drivers/study/causes.hpp"
#include "drivers/study/channel.hpp"
#include "drivers/study/columns.hpp"
#include "drivers/tolerance/tolerance_run.hpp"
#include "drivers/version.hpp"
#include "host/material/library.hpp"
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <thread>
#include <unistd.h>

namespace {

void resume_run(const std::string& what, const std::string& folder, const std::vector<std::string>& settings,
                drivers::RunOptions options) {
  const auto found = drivers::find_resumption(what, folder, settings);
  if (!found) {
    fmt::print("{}: the run is complete\n", what);
    return;
  }
  options.checkpoint = found->checkpoint;
  drivers::run_scene(found->scene, options);
}

std::string data_folder() {
  return std::filesystem::weakly_canonical(host::beside_program("../data")).string();
}

/// Runs whose resolution is chosen, or that are many: `action` is what `simsand run` then does instead of one run.
void add_run_kinds(CLI::App& run, drivers::ToleranceOptions& one, calibration::PropagateOptions& many) {
  one.data = many.study.data = data_folder();
  many.study.folder.clear();
  many.study.parallel = int(std::thread::hardware_concurrency());
  auto* tolerance = run.add_option_function<std::string>(
                           "--tolerance",
                           [&one](const std::string& text) { one.tolerance = drivers::read_tolerance(text); },
                           "as 5%: chooses resolution, geometry, material, stiffness scale and precision for "
                           "h_f and r_f within it, and estimates their error (tests/charts/ACCURACY.md)")
                        ->excludes("--resume")
                        ->excludes("--plan");
  run.add_option("--data", one.data, "data folder of the project, with the chart of --tolerance");
  auto* posterior =
      run.add_option("--posterior", many.posterior,
                     "fit.h5 of simsand calibrate: runs the scene for sets of parameters drawn from it")
          ->excludes(tolerance)
          ->excludes("--resume")
          ->excludes("--plan");
  run.add_option("-n,--sets", many.sets, "sets drawn")->check(CLI::Range(2, 100000))->needs(posterior);
  run.add_option("--seed", many.seed, "of the draw")->needs(posterior);
  run.add_option("-j,--jobs", many.study.parallel, "sets at a time")
      ->check(CLI::Range(1, 1024))
      ->needs(posterior);
}

void add_run(CLI::App& app) {
  static std::string file, folder; // live as long as the program: CLI11 writes into them
  static int threads = 0;
  static std::vector<std::string> settings;
  static drivers::RunOptions options;
  static bool resume = false, plan = false;
  static drivers::ToleranceOptions tolerance;
  static calibration::PropagateOptions posterior;
  auto* run = app.add_subcommand("run", "Run a scene: a column collapses and comes to rest");
  run->add_option("SCENE", file,
                  "scene file (.toml), or a result file (.h5) whose stored scene is run again; "
                  "with --resume also the folder of the results")
      ->required();
  run->add_option("-o,--output", folder, "folder for the results, instead of the scene's output.folder");
  run->add_option("-t,--threads", threads, "threads; results do not depend on their number")
      ->check(CLI::Range(1, 1024));
  run->add_option("--set", settings, "TABLE.KEY=VALUE in place of what the scene says; repeatable")
      ->allow_extra_args(false);
  run->add_flag("-q,--quiet", options.quiet, "no progress");
  auto* go_on = run->add_flag("--resume", resume, "go on with an interrupted run from its checkpoint");
  run->add_flag("--plan", plan, "only say what the run will take: particles, steps, time, memory, disk")
      ->excludes(go_on);
  add_run_kinds(*run, tolerance, posterior);
  run->callback([] {
    if (threads > 0) omp_set_num_threads(threads);
    if (!posterior.posterior.empty()) {
      posterior.scene = file;
      posterior.settings = settings;
      posterior.study.folder = folder;
      posterior.study.quiet = options.quiet;
      return calibration::propagate(posterior);
    }
    drivers::listen_for_signals();
    if (tolerance.tolerance > 0) {
      tolerance.scene = file;
      tolerance.settings = settings;
      tolerance.folder = folder;
      drivers::run_to_tolerance(tolerance, options);
      return;
    }
    if (resume) return resume_run(file, folder, settings, options);
    auto scene = drivers::read_scene(file, settings);
    if (!folder.empty()) scene.output_folder = folder;
    if (plan) {
      fmt::print("{}", drivers::described(drivers::plan_run(scene), scene));
      return;
    }
    drivers::run_scene(scene, options);
  });
}

void add_info(CLI::App& app) {
  static std::string file;
  static bool json = false;
  auto* info = app.add_subcommand("info", "Say what is in a result or a checkpoint");
  info->add_option("FILE", file, "result.h5 or checkpoint.h5")->required();
  info->add_flag("--json", json, "one JSON object for other programs");
  info->callback([] { fmt::print("{}", drivers::describe_file(file, json)); });
}

void add_element(CLI::App& app) {
  static drivers::ElementBatch batch;
  auto* element = app.add_subcommand("element", "Lead one material point along a path of stress and strain");
  element->add_option("PATH", batch.path_files, "path files (.toml); vocabulary: drivers/element/ELEMENT.md")
      ->required();
  element->add_option("-o,--output", batch.output,
                      "table (.csv), default: standard output; several paths: folder for a table of each");
  element->add_option("--figures", batch.figures, "folder for pictures of all tables");
  element->add_option("--envelope", batch.envelope,
                      "table of envelope stages (.csv), default: OUTPUT_envelope.csv");
  element->add_option("--resolved", batch.resolved, "file for the path with every key written out");
  element
      ->add_option("--set", batch.settings, "KEY=VALUE, in place of the path file's, such as material.phi=30")
      ->allow_extra_args(false);
  element->add_option("-t,--threads", batch.threads, "paths at a time")->check(CLI::Range(1, 1024));
  element->callback([] {
    if (drivers::run_elements(batch) != 0) throw CLI::RuntimeError(1);
  });
}

void add_abaqus(CLI::App& app) {
  static std::string file;
  static drivers::AbaqusOptions options;
  auto* abaqus = app.add_subcommand("abaqus", "Write an ABAQUS/Explicit deck of a scene");
  abaqus
      ->add_option("SCENE", file,
                   "scene file (.toml), or a result file (.h5); manual: drivers/abaqus/ABAQUS.md")
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

/// What all studies ask for.
void add_study_options(CLI::App& command, drivers::StudyOptions& options) {
  options.data = data_folder();
  options.parallel = int(std::thread::hardware_concurrency());
  command.add_option("-o,--output", options.folder, "folder for runs, tables, pictures and the page")
      ->capture_default_str();
  command.add_option("-j,--jobs", options.parallel, "runs at a time")->check(CLI::Range(1, 1024));
  command.add_option("--data", options.data, "data folder of the project");
  command.add_flag("-q,--quiet", options.quiet, "no progress");
  command.add_flag("--again", options.again, "run complete ones again that another build has made");
}

void add_study(CLI::App& app) {
  static drivers::ColumnStudyOptions columns;
  static drivers::ChannelStudyOptions channel;
  auto* study = app.add_subcommand("study", "Published collapses, run and compared; complete runs stay")
                    ->require_subcommand(1);
  auto* command = study->add_subcommand("columns", "The 24 columns of Jin, Lu and Yang");
  add_study_options(*command, columns.study);
  command->add_option("--spacing", columns.spacings, "distances of particles, m; the finest is shown")
      ->delimiter(',')
      ->check(CLI::Range(1e-4, 1e-2))
      ->capture_default_str();
  command->add_option("--sets", columns.sets, "parameters: drivers/study/COLUMNS.md")
      ->delimiter(',')
      ->check(CLI::IsMember(drivers::parameter_sets()))
      ->capture_default_str();
  command->add_option("--only", columns.only, "only columns with this in their names, as ss_dense or a0.5");
  command->callback([] { drivers::study_columns(columns); });

  static drivers::CauseStudyOptions causes;
  command = study->add_subcommand("causes", "Why SPH and discrete elements of the same grains differ");
  add_study_options(*command, causes.study);
  command->add_option("--spacing", causes.spacing, "distance of particles, m")
      ->check(CLI::Range(1e-3, 1e-2))
      ->capture_default_str();
  command->callback([] { drivers::study_causes(causes); });

  command = study->add_subcommand("channel", "The rods of Bui et al., by SIMSAND and Drucker-Prager");
  add_study_options(*command, channel.study);
  command->add_option("--spacing", channel.spacing, "distance of particles, m")
      ->check(CLI::Range(2e-4, 2e-2))
      ->capture_default_str();
  command->callback([] { drivers::study_channel(channel); });
}

void add_calibrate(CLI::App& app) {
  static calibration::CalibrateOptions options;
  static int threads = 0;
  auto* calibrate = app.add_subcommand("calibrate", "Fit parameters to laboratory tests");
  calibrate->add_option("FIT", options.fit_file, "fit file (.toml); manual: calibration/README.md")
      ->required();
  calibrate->add_option("-o,--output", options.folder,
                        "folder for the results, instead of the fit's output.folder");
  calibrate->add_option("-t,--threads", threads, "threads; results do not depend on their number")
      ->check(CLI::Range(1, 1024));
  calibrate->add_flag("-q,--quiet", options.quiet, "no progress");
  calibrate->add_flag("--resume", options.resume, "go on with an interrupted run");
  calibrate->add_flag("--best-only", options.best_only, "least squares alone, no sampling");
  calibrate
      ->add_option("--coverage", options.coverage,
                   "fit so many synthetic data sets and count the intervals that hold the truth")
      ->check(CLI::Range(1, 100000));
  calibrate->callback([] {
    if (threads > 0) omp_set_num_threads(threads);
    options.command =
        fmt::format("simsand calibrate {}{}", options.fit_file, options.best_only ? " --best-only" : "");
    calibration::calibrate(options);
  });
}

/// Threads that wait at the end of a stage sleep after a moment. By default they spin for milliseconds, and where
/// another program needs the same cores a run on two threads then takes ten times as long; without any spinning two
/// free cores are no faster than one. OpenMP reads its settings before main, so the program starts anew with
/// these, unless the user has chosen.
void wait_passively(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY")) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "1000", 0); // turns: some microseconds
  execv("/proc/self/exe", argv);       // returns only if it fails: then go on as we are
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
    add_info(app);
    add_element(app);
    add_abaqus(app);
    add_study(app);
    add_calibrate(app);
    commands::add_compile(app);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const drivers::Interrupted& stop) {
    fmt::print(stderr, "simsand: {}\n", stop.what());
    return 128 + stop.signal; // as a shell counts
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand: {}\n", error.what());
    return 1;
  }
  return 0;
}
