// SPDX-License-Identifier: BSD-3-Clause
// The six conditions of a stage, from its table in the path file.
#pragma once
#include "drivers/element/load_path.hpp"

namespace drivers {

/// Reads the conditions and the held total stress of a stage, whose `control`, `cyclic` and `replay` are read already.
void read_conditions(const TomlTable& table, Stage& stage);

/// Names of the controls whose conditions stand in the path file.
Words general_control_names();

/// The one of `keys` that the table has. Throws std::runtime_error with FILE:LINE if it has none, or several.
std::string only_one_of(const TomlTable& table, const Words& keys);

/// Six components.
Vector6 read_six(const TomlTable& table, std::string_view key,
                 std::optional<std::vector<double>> fallback = {});

} // namespace drivers
