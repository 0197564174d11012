// SPDX-License-Identifier: BSD-3-Clause
#include "host/bodies/disc.hpp"
#include "host/scheme/kernel.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace host {
namespace {

using Place = std::array<double, 2>;

std::vector<Place> place_rings(const std::vector<int>& quarters) {
  const double all = std::accumulate(quarters.begin(), quarters.end(), 0), radius = double(quarters.size());
  std::vector<Place> places;
  int inside = 0;
  for (const int quarter : quarters) {
    const double inner = radius * std::sqrt(inside / all),
                 outer = radius * std::sqrt((inside + quarter) / all);
    inside += quarter;
    for (int k = 0; k < quarter; ++k) {
      const double angle = (k + 0.5) / quarter * std::numbers::pi / 2, r = 0.5 * (inner + outer);
      places.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  }
  return places;
}

/// -W'(r)/r summed over a stack of equal layers one spacing apart.
double stacked_slope(const Kernel<3>& kernel, double square) {
  double sum = 0;
  const int layers = int(kernel.support);
  for (int k = -layers; k <= layers; ++k) sum -= kernel.gradient_factor(std::sqrt(square + k * k));
  return sum;
}

/// -sum V grad W at places[i] over the whole disc (from index `first` to `last` in its quarters) and its images
/// behind the wall: the direction in which a uniform pressure pushes the particle.
Place push(const std::vector<Place>& places, int i, int first, int last, double radius, double volume,
           const Kernel<3>& kernel) {
  Place sum{};
  const auto add = [&](double x, double y, double weight) {
    const double dx = places[i][0] - x, dy = places[i][1] - y, square = dx * dx + dy * dy;
    if (square >= kernel.support * kernel.support) return;
    const double slope = weight * stacked_slope(kernel, square);
    sum[0] += slope * dx;
    sum[1] += slope * dy;
  };
  for (int j = first; j < last; ++j) {
    const double r = std::hypot(places[j][0], places[j][1]), stretch = (2 * radius - r) / r;
    for (const double sx : {1, -1})
      for (const double sy : {1, -1}) {
        add(sx * places[j][0], sy * places[j][1], volume);
        if (r > radius - kernel.support)
          add(sx * stretch * places[j][0], sy * stretch * places[j][1], stretch * volume);
      }
  }
  return sum;
}

} // namespace

std::vector<int> ring_quarters(int rings) {
  std::vector<int> quarters(rings);
  int inside = 0;
  for (int k = 0; k < rings; ++k) {
    const int to = std::max(inside + 1, int(std::lround(0.25 * std::numbers::pi * (k + 1) * (k + 1))));
    quarters[k] = to - inside;
    inside = to;
  }
  return quarters;
}

std::vector<Place> quarter_disc(int rings, double smoothing_length) {
  constexpr int sweeps = 60; // leave a hundredth of the unevenness of the rings
  constexpr double part = 0.3;
  const Kernel<3> kernel(smoothing_length);
  const auto quarters = ring_quarters(rings);
  auto places = place_rings(quarters);
  const int count = int(places.size()), reach = int(kernel.support) + 2; // rings
  const double radius = rings, volume = std::numbers::pi * radius * radius / (4.0 * count);
  std::vector<int> start(rings + 1, 0), ring;
  std::partial_sum(quarters.begin(), quarters.end(), start.begin() + 1);
  for (int k = 0; k < rings; ++k) ring.insert(ring.end(), quarters[k], k);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    auto moved = places;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < count; ++i) {
      const int first = start[std::max(0, ring[i] - reach)],
                last = start[std::min(rings, ring[i] + reach + 1)];
      const Place force = push(places, i, first, last, radius, volume, kernel);
      for (int a = 0; a < 2; ++a) moved[i][a] += part * force[a];
    }
    places = moved;
  }
  return places;
}

} // namespace host
