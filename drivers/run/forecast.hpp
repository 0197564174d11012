// SPDX-License-Identifier: BSD-3-Clause
// What a run will take, as far as it can be told before.
#pragma once
#include "host/scene.hpp"

namespace drivers {

/// Simulated time, s, at which a run of the scene is expected to end: at rest, or at the scene's latest end. The
/// time to rest follows from column and gravity (measured on columns, see the source); single runs scatter
/// about it by a factor of 1.3, a few by 2 or 3.
double expected_end(const host::Scene& scene);

} // namespace drivers
