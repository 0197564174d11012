// SPDX-License-Identifier: BSD-3-Clause
// What `simsand run` may do in place of one run. Each kind is a file of its own, listed by `add_run_kind` in CMake.
#pragma once
#include "drivers/files/toml_text.hpp"
#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace commands {

/// What the user asked `simsand run` for.
struct RunRequest {
  std::string scene;  ///< file
  std::string folder; ///< for the results; empty: the scene's
  drivers::Words settings;
  bool quiet = false;
};

/// A kind of run: the option that chooses it, and what is done then.
struct RunKind {
  CLI::Option* option;
  std::function<void(const RunRequest&)> run;
};

} // namespace commands
