// SPDX-License-Identifier: BSD-3-Clause
// The tables [[wall]] of a scene. Every key, its unit and its default: README.md, "Walls".
#pragma once
#include "drivers/files/toml_table.hpp"
#include "host/scene.hpp"

namespace drivers {

/// Reads the walls of a scene whose geometry is known. Throws std::runtime_error with one line that names file,
/// line and key, also for a wall that makes no sense.
std::vector<host::Wall> read_walls(const TomlTable& root, const host::Scene& scene);

/// The place of a column among walls: the keys of [column] that only scenes with walls have.
void read_placement(const TomlTable& column, host::Scene& scene);

/// Throws the same if a wall, the floor or the gate cuts the column, or is too narrow for the reach of particles.
void check_walls(const TomlTable& root, const host::Scene& scene);

} // namespace drivers
