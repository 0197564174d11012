// SPDX-License-Identifier: BSD-3-Clause
// The command line. Each command is a file that `add_subcommand` lists in CMake.
#include "drivers/commands/subcommands.hpp"
#include "drivers/files/toml_text.hpp"
#include "drivers/run/interrupt.hpp"
#include "drivers/version.hpp"
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <span>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace {

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

/// The first word that stands where a command is expected and is none, with the nearest one; empty without such a word.
std::string unknown_command(const CLI::App& root, std::span<char*> words) {
  const CLI::App* app = &root;
  for (const std::string word : words) {
    if (word.starts_with('-')) break;
    const CLI::App* next = nullptr;
    drivers::Words names;
    for (const auto* command : app->get_subcommands({})) {
      names.push_back(command->get_name());
      if (command->get_name() == word) next = command;
    }
    if (names.empty()) break; // what follows are arguments
    if (!next) {
      const auto near = drivers::nearest_word(word, names);
      return fmt::format("unknown command '{}'{}", word, near.empty() ? "" : ", perhaps '" + near + "'");
    }
    app = next;
  }
  return {};
}

int run_command(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::RequiredError& error) {
    const auto unknown = unknown_command(app, std::span(argv, std::size_t(argc)).subspan(1));
    if (unknown.empty()) return app.exit(error);
    fmt::print(stderr, "simsand: {}; see simsand --help\n", unknown);
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
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
    for (const auto add : commands::subcommands) add(app);
    return run_command(app, argc, argv);
  } catch (const drivers::Interrupted& stop) {
    fmt::print(stderr, "simsand: {}\n", stop.what());
    return 128 + stop.signal; // as a shell counts
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand: {}\n", error.what());
    return 1;
  }
}
