// SPDX-License-Identifier: BSD-3-Clause
// A rigid facet in space.
#pragma once
#include "tests/abaqus/deck_model.hpp"
#include <algorithm>
#include <cmath>
#include <optional>

namespace deck {

inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Four corners as the deck orders them; the normal is right-handed.
struct Facet {
  std::array<Point, 4> corner;
  Point normal{}, centre{};
  double diameter = 0;

  explicit Facet(const std::array<Point, 4>& c) : corner(c) {
    const Point n = cross(minus(c[2], c[0]), minus(c[3], c[1]));
    const double length = std::sqrt(dot(n, n));
    for (int k = 0; k < 3; ++k) {
      normal[k] = length > 0 ? n[k] / length : 0;
      centre[k] = (c[0][k] + c[1][k] + c[2][k] + c[3][k]) / 4;
    }
    diameter = std::sqrt(
        std::max(dot(minus(c[2], c[0]), minus(c[2], c[0])), dot(minus(c[3], c[1]), minus(c[3], c[1]))));
  }
  bool sound() const {
    for (int i = 0; i < 4; ++i) // convex: every corner turns the same way
      if (!(dot(normal, cross(minus(corner[(i + 1) % 4], corner[i]),
                              minus(corner[(i + 2) % 4], corner[(i + 1) % 4]))) > 0))
        return false;
    return std::abs(dot(normal, minus(corner[0], centre))) < 1e-6 * diameter;
  }
  /// Distance along the normal, where the point lies over the facet.
  std::optional<double> distance(const Point& p) const {
    for (int i = 0; i < 4; ++i)
      if (dot(normal, cross(minus(corner[(i + 1) % 4], corner[i]), minus(p, corner[i]))) < 0)
        return std::nullopt;
    return dot(normal, minus(p, centre));
  }
};

} // namespace deck
