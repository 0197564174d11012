// SPDX-License-Identifier: BSD-3-Clause
// `simsand info`: what a result or a checkpoint holds.
#include "drivers/run/info.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace commands {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

} // namespace

void add_info(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("info", "Say what is in a result or a checkpoint");
  command->add_option("FILE", options->file, "result.h5 or checkpoint.h5")->required();
  command->add_flag("--json", options->json, "one JSON object for other programs");
  command->callback([options] { fmt::print("{}", drivers::describe_file(options->file, options->json)); });
}

} // namespace commands
