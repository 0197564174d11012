// SPDX-License-Identifier: BSD-3-Clause
// A request to stop: SIGINT, SIGTERM and SIGHUP let the step end, so that the run can save what it needs to
// go on. A second signal of the same kind ends the program at once.
#pragma once
#include <stdexcept>
#include <string>

namespace drivers {

/// The run stopped on request, with a checkpoint on disk.
struct Interrupted : std::runtime_error {
  Interrupted(const std::string& message, int by) : std::runtime_error(message), signal(by) {}
  int signal;
};

/// Installs the handlers; signals that the caller ignored (nohup) stay ignored. SIGXFSZ is ignored, so that a file that
/// grows beyond the shell's limit makes its write fail and does not end the program.
void listen_for_signals();

/// The signal that asked to stop; 0 if none has.
int stop_requested();

} // namespace drivers
