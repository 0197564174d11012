// SPDX-License-Identifier: BSD-3-Clause
// What each keyword may hold: parameters, place in the file, values on a line.
#pragma once
#include "tests/abaqus/deck_reader.hpp"

namespace deck {

void check_syntax(const std::vector<Block>& blocks, Findings& findings);

} // namespace deck
