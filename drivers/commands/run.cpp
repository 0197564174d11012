// SPDX-License-Identifier: BSD-3-Clause
// `simsand run`: one run of a scene, what it will take, or another kind of run.
#include "drivers/commands/run.hpp"
#include "drivers/commands/run_kinds.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/run/interrupt.hpp"
#include "drivers/run/plan.hpp"
#include "drivers/run/resume.hpp"
#include "drivers/run/run.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <omp.h>

namespace commands {
namespace {

struct Options {
  RunRequest request;
  int threads = 0;
  bool resume = false, plan = false;
};

void resume_run(const RunRequest& request) {
  const auto found = drivers::find_resumption(request.scene, request.folder, request.settings);
  if (!found) {
    fmt::print("{}: the run is complete\n", request.scene);
    return;
  }
  drivers::run_scene(found->scene, {request.quiet, found->checkpoint});
}

void run(const Options& options) {
  const auto& request = options.request;
  drivers::listen_for_signals();
  if (options.resume) return resume_run(request);
  auto scene = drivers::read_scene(request.scene, request.settings);
  if (!request.folder.empty()) scene.output_folder = request.folder;
  if (options.plan)
    fmt::print("{}", drivers::described(drivers::plan_run(scene), scene));
  else
    drivers::run_scene(scene, {request.quiet});
}

/// Adds the options of all kinds of runs; a user chooses at most one of them.
std::vector<RunKind> add_kinds(CLI::App& command, std::vector<CLI::Option*> others) {
  std::vector<RunKind> kinds;
  for (const auto add : run_kinds) {
    kinds.push_back(add(command));
    for (auto* other : others) kinds.back().option->excludes(other);
    others.push_back(kinds.back().option);
  }
  return kinds;
}

} // namespace

void add_run(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto& request = options->request;
  auto* command = app.add_subcommand("run", "Run a scene: a column collapses and comes to rest");
  command
      ->add_option("SCENE", request.scene,
                   "scene file (.toml), or a result file (.h5) whose stored scene is run again; "
                   "with --resume also the folder of the results")
      ->required();
  command->add_option("-o,--output", request.folder,
                      "folder for the results, instead of the scene's output.folder");
  command->add_option("-t,--threads", options->threads, "threads; results do not depend on their number")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--set", request.settings, "TABLE.KEY=VALUE in place of what the scene says; repeatable")
      ->allow_extra_args(false);
  command->add_flag("-q,--quiet", request.quiet, "no progress");
  auto* resume =
      command->add_flag("--resume", options->resume, "go on with an interrupted run from its checkpoint");
  auto* plan = command->add_flag("--plan", options->plan,
                                 "only say what the run will take: particles, steps, time, memory, disk");
  plan->excludes(resume);
  const auto kinds = add_kinds(*command, {resume, plan});
  command->callback([options, kinds] {
    if (options->threads > 0) omp_set_num_threads(options->threads);
    for (const auto& kind : kinds)
      if (kind.option->count() > 0) return kind.run(options->request);
    run(*options);
  });
}

} // namespace commands
