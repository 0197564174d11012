// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/forecast.hpp"
#include <algorithm>
#include <cmath>

namespace drivers {

// A sheet of sand comes to rest in some sqrt(r0 / g) whatever its height; a low column sooner, for only its
// edge moves. Fitted to 40 columns, a = 0.5 to 10, spacings of 2 to 5 mm, dense and loose, plane and
// axisymmetric; `tests/benchmark/plan.py` runs such columns and compares.
double expected_end(const host::Scene& scene) {
  if (scene.gate.motion == host::GateMotion::fixed || scene.rest_fraction == 0 || !scene.walls.empty())
    return scene.end_time;
  const double aspect = scene.column.height / scene.column.radius;
  const double rest = 10.5 * aspect / (aspect + 0.5) * std::sqrt(scene.column.radius / scene.gravity);
  const double cleared =
      scene.gate.motion == host::GateMotion::lift ? scene.column.height / scene.gate.speed : 0;
  return std::min(std::max(rest, cleared), scene.end_time);
}

} // namespace drivers
