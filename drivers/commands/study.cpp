// SPDX-License-Identifier: BSD-3-Clause
// `simsand study`: published collapses, run and compared.
#include "drivers/files/resource.hpp"
#include "drivers/study/causes.hpp"
#include "drivers/study/channel.hpp"
#include "drivers/study/columns.hpp"
#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

namespace commands {
namespace {

/// Adds a study with the options that all studies have, and what it does.
template <class Options>
CLI::App& add_one(CLI::App& study, const std::string& name, const std::string& about,
                  const std::shared_ptr<Options>& options, void (*run)(const Options&)) {
  auto& command = *study.add_subcommand(name, about);
  auto& common = options->study;
  common.parallel = int(std::thread::hardware_concurrency());
  command.add_option("-o,--output", common.folder, "folder for runs, tables, pictures and the page")
      ->capture_default_str();
  command.add_option("-j,--jobs", common.parallel, "runs at a time")->check(CLI::Range(1, 1024));
  command.add_option("--data", common.data, "data folder; default: that of the program");
  command.add_flag("-q,--quiet", common.quiet, "no progress");
  command.add_flag("--again", common.again, "run complete ones again that another build has made");
  command.callback([options, run] {
    if (options->study.data.empty()) options->study.data = drivers::data_folder();
    run(*options);
  });
  return command;
}

void add_columns(CLI::App& study) {
  const auto options = std::make_shared<drivers::ColumnStudyOptions>();
  auto& command =
      add_one(study, "columns", "The 24 columns of Jin, Lu and Yang", options, drivers::study_columns);
  command.add_option("--spacing", options->spacings, "distances of particles, m; the finest is shown")
      ->delimiter(',')
      ->check(CLI::Range(1e-4, 1e-2))
      ->capture_default_str();
  command.add_option("--sets", options->sets, "parameters: drivers/study/COLUMNS.md")
      ->delimiter(',')
      ->check(CLI::IsMember(drivers::parameter_sets()))
      ->capture_default_str();
  command.add_option("--only", options->only, "only columns with this in their names, as ss_dense or a0.5");
}

void add_causes(CLI::App& study) {
  const auto options = std::make_shared<drivers::CauseStudyOptions>();
  add_one(study, "causes", "Why SPH and discrete elements of the same grains differ", options,
          drivers::study_causes)
      .add_option("--spacing", options->spacing, "distance of particles, m")
      ->check(CLI::Range(1e-3, 1e-2))
      ->capture_default_str();
}

void add_channel(CLI::App& study) {
  const auto options = std::make_shared<drivers::ChannelStudyOptions>();
  add_one(study, "channel", "The rods of Bui et al., by SIMSAND and Drucker-Prager", options,
          drivers::study_channel)
      .add_option("--spacing", options->spacing, "distance of particles, m")
      ->check(CLI::Range(2e-4, 2e-2))
      ->capture_default_str();
}

} // namespace

void add_study(CLI::App& app) {
  auto* study = app.add_subcommand("study", "Published collapses, run and compared; complete runs stay")
                    ->require_subcommand(1);
  add_columns(*study);
  add_causes(*study);
  add_channel(*study);
}

} // namespace commands
