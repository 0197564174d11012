// SPDX-License-Identifier: BSD-3-Clause
// `simsand element`: laboratory tests on one material point.
#include "drivers/element/command.hpp"
#include <CLI/CLI.hpp>
#include <memory>

namespace commands {

void add_element(CLI::App& app) {
  const auto batch = std::make_shared<drivers::ElementBatch>();
  auto* command = app.add_subcommand("element", "Lead one material point along a path of stress and strain");
  command->add_option("PATH", batch->path_files, "path files (.toml); vocabulary: drivers/element/ELEMENT.md")
      ->required();
  command->add_option("-o,--output", batch->output,
                      "table (.csv), default: standard output; several paths: folder for a table of each");
  command->add_option("--figures", batch->figures, "folder for pictures of all tables");
  command->add_option("--envelope", batch->envelope,
                      "table of envelope stages (.csv), default: OUTPUT_envelope.csv");
  command->add_option("--resolved", batch->resolved, "file for the path with every key written out");
  command
      ->add_option("--set", batch->settings,
                   "KEY=VALUE, in place of the path file's, such as material.phi=30")
      ->allow_extra_args(false);
  command->add_option("-t,--threads", batch->threads, "paths at a time")->check(CLI::Range(1, 1024));
  command->callback([batch] {
    if (drivers::run_elements(*batch) != 0) throw CLI::RuntimeError(1);
  });
}

} // namespace commands
