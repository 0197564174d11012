// SPDX-License-Identifier: BSD-3-Clause
// Pictures, drawn by scripts of the share folder (drivers/files/resource.hpp): of element tests by
// drivers/figures/element_figures.py.
#pragma once
#include "drivers/element/critical_state.hpp"

namespace drivers {

/// Runs a script, by its name in the share folder, that draws into `folder`. Throws std::runtime_error if it is missing or fails; what it lacks it says
/// itself, on standard error.
void run_script(const std::string& name, const Words& arguments, const std::string& folder);

/// A table to be drawn, with the critical state whose lines accompany it.
struct Picture {
  std::string table;
  std::optional<CriticalState> critical;
};

/// Draws all tables into the pictures of one folder. Throws std::runtime_error if the script is missing or fails.
void draw_pictures(const std::vector<Picture>& pictures, const std::string& folder);

} // namespace drivers
