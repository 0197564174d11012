// SPDX-License-Identifier: BSD-3-Clause
// What a subroutine is told of the run that calls it.
#pragma once
#include <string>

namespace host {

struct Job {
  std::string name = "simsand"; ///< answer of vgetjobname
  /// Answer of vgetoutdir, and where the evidence of a failed call is written; empty: the working folder, no evidence.
  std::string folder{};
};

} // namespace host
