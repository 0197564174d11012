// SPDX-License-Identifier: BSD-3-Clause
// Other programs, started with a list of arguments. No shell reads the arguments, so a file name cannot be taken for a
// command.
#pragma once
#include "drivers/files/toml_text.hpp"
#include <string>
#include <sys/types.h>

namespace drivers {

/// A program to start: its path, or a name to look for in PATH, then its arguments.
struct Program {
  Words command;
  std::string log{};             ///< file that takes its output and its errors, replaced; empty: ours
  bool ends_with_parent = false; ///< SIGTERM for it when the thread that started it ends, however that ends
};

/// Starts it and does not wait. Throws std::runtime_error "PROGRAM: cannot be started: REASON".
pid_t start_program(const Program& program);

/// Starts it and waits: its exit status, or 128 + the signal that ended it. Errors as of `start_program`.
int run_program(const Program& program);

/// Runs a Python script and waits, as `run_program`; by Debian's Python where it is installed, which has Debian's
/// numpy, h5py and matplotlib.
int run_python(const std::string& script, const Words& arguments);

/// The command as a user can type it into a shell.
std::string shell_text(const Words& command);

/// The command by which `run_python` runs a script.
Words python_command(const std::string& script, const Words& arguments);

} // namespace drivers
