// SPDX-License-Identifier: BSD-3-Clause
// Pictures of element tests, drawn by drivers/figures/element_figures.py, which the build puts beside the program.
#pragma once
#include "drivers/element/critical_state.hpp"

namespace drivers {

/// A table to be drawn, with the critical state whose lines accompany it.
struct Picture {
  std::string table;
  std::optional<CriticalState> critical;
};

/// Draws all tables into the pictures of one folder. Throws std::runtime_error if the script is missing or fails.
void draw_pictures(const std::vector<Picture>& pictures, const std::string& folder);

} // namespace drivers
