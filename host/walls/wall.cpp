// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/wall.hpp"
#include <algorithm>
#include <cmath>

namespace host {

WallVector WallMotion::displacement(double at) const {
  WallVector sum{};
  for (std::size_t k = 0; k + 1 < time.size(); ++k) {
    const auto integral = [&](double to, int a) { // from time[k], of the line between two velocities
      const double dt = to - time[k], slope = (velocity[k + 1][a] - velocity[k][a]) / (time[k + 1] - time[k]);
      return dt * (velocity[k][a] + 0.5 * slope * dt);
    };
    const double from = std::clamp(0.0, time[k], time[k + 1]), to = std::clamp(at, from, time[k + 1]);
    for (int a = 0; a < 3; ++a) sum[a] += integral(to, a) - integral(from, a);
  }
  return sum;
}

WallVector WallMotion::between(std::size_t k, double at) const {
  const double share = (at - time[k]) / (time[k + 1] - time[k]);
  WallVector v;
  for (int a = 0; a < 3; ++a) v[a] = std::lerp(velocity[k][a], velocity[k + 1][a], share);
  return v;
}

} // namespace host
