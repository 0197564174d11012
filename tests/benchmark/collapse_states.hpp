// SPDX-License-Identifier: BSD-3-Clause
// What a collapse asks of its material: the inputs of VUMAT calls of a run of a scene, as they came.
#pragma once
#include "tests/benchmark/states.hpp"
#include <string>

namespace benchmark {

/// Runs a scene and keeps the inputs of the updates of some of its steps, about `count`, evenly spread over the
/// time of a collapse. Throws std::runtime_error.
States record_collapse(const std::string& scene_file, int count);

} // namespace benchmark
