// SPDX-License-Identifier: BSD-3-Clause
// Reads an ABAQUS/Explicit deck back, from the published keyword rules and the physics of a column of
// sand; knows nothing of the program that wrote it.
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace deck {

struct Finding {
  int line = 0; ///< from 1; 0: something is absent
  std::string text;
};
using Findings = std::vector<Finding>;

/// What the deck is to describe, SI units.
struct Expected {
  double radius = 0, height = 0; ///< m, of the column; plane strain: half width
  bool slab = false;             ///< plane strain: between two sides along y
  double density = 0, gravity = 0, pressure_ratio = 0;
  double friction = 0; ///< of the floor; negative: rough
  double end_time = 0;
  double lift_speed = 0; ///< m/s; 0: the wall, if any, stands
  bool wall = true;
  std::vector<double> constants;
  std::size_t state_variables = 0;
  double first_state = std::numeric_limits<double>::quiet_NaN(); ///< of every particle; NaN: any
};

/// All findings, in the order of their lines. A deck in order has none.
Findings check(const std::string& text, const Expected& expected);

/// One per line.
std::string described(const Findings& findings);

} // namespace deck
