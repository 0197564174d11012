// SPDX-License-Identifier: BSD-3-Clause
// Scenes from TOML. Every key, its unit and its default: README.md, "Writing a scene".
#pragma once
#include "host/scene.hpp"
#include <string>

namespace drivers {

/// Reads a scene file, or the scene stored in a result file (`.h5`), with `settings` ("table.key=value") in place
/// of what it says, and loads its material. Throws std::runtime_error with one line that names file, line and
/// key.
host::Scene read_scene(const std::string& path, const std::vector<std::string>& settings = {});

} // namespace drivers
