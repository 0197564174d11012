// SPDX-License-Identifier: BSD-3-Clause
// The walls of a scene as smooth surfaces, where they are at one time: a plane is one surface, a box has one for
// each side, a cylinder its mantle and, where sand is outside, its ends. What sand feels of a wall is decided here:
// distance, normal, which part of a surface exists.
#pragma once
#include "host/scene.hpp"
#include <cmath>

namespace host {

template <int D> struct Point : std::array<double, std::size_t(D)> {};

template <int D> struct Surface {
  int wall = 0;                ///< position in `all_walls`
  bool no_slip = false;        ///< of that wall
  bool mantle = false;         ///< of a cylinder about the vertical axis; else a plane
  Point<D> point{}, normal{};  ///< plane: a point of it, unit normal towards the sand
  double radius = 0, side = 1; ///< mantle; side 1: sand outside, -1: inside
  Point<D> center{};           ///< mantle: of its axis
  bool obstacle = false;       ///< a bounded body: sand on all sides of [lower, upper]
  bool shell = false;          ///< mantle that ends at lower and upper heights and has no thickness
  Point<D> lower{}, upper{};   ///< extents of obstacle and shell, m
  Point<D> velocity{};         ///< m/s, mean of the step
};

/// Floor and gate, where the scene has them, then its walls.
std::vector<Wall> all_walls(const Scene& scene);

/// Puts all surfaces at `time`, s, with their mean velocity over the `dt` before it (0: velocity 0), into `list`.
template <int D>
void find_surfaces(const std::vector<Wall>& walls, GeometryKind geometry, double time, double dt,
                   std::vector<Surface<D>>& list);

template <int D>
std::vector<Surface<D>> surfaces_at(const std::vector<Wall>& walls, GeometryKind geometry, double time,
                                    double dt) {
  std::vector<Surface<D>> list;
  find_surfaces(walls, geometry, time, dt, list);
  return list;
}

/// Distance from the surface (a plane or mantle without end), m, positive on the side of the sand.
template <int D, class P> double distance(const Surface<D>& s, const P& x) {
  if (s.mantle) return s.side * (std::hypot(x[0] - s.center[0], x[1] - s.center[1]) - s.radius);
  double sum = 0;
  for (int a = 0; a < D; ++a) sum += (x[a] - s.point[a]) * s.normal[a];
  return sum;
}

/// Unit normal towards the sand at x; on the axis of a mantle any horizontal one.
template <int D, class P> Point<D> normal_of(const Surface<D>& s, const P& x) {
  if (!s.mantle) return s.normal;
  Point<D> n{};
  const double dx = x[0] - s.center[0], dy = x[1] - s.center[1], r = std::hypot(dx, dy);
  n[0] = s.side * (r > 0 ? dx / r : 1);
  n[1] = s.side * (r > 0 ? dy / r : 0);
  return n;
}

/// Reflects x in the surface, at a mantle in its tangent plane; returns how much longer the circle of the image is.
template <int D, class P> double reflect(const Surface<D>& s, P& x) {
  if (!s.mantle) {
    const double twice = 2 * distance(s, x);
    for (int a = 0; a < D; ++a) x[a] -= twice * s.normal[a];
    return 1;
  }
  const double r = std::hypot(x[0] - s.center[0], x[1] - s.center[1]);
  const double stretch = r > 0 ? (2 * s.radius - r) / r : 0;
  for (int a = 0; a < 2; ++a) x[a] = s.center[a] + stretch * (x[a] - s.center[a]);
  return std::max(stretch, 0.0);
}

/// Signed distance from the body of an obstacle, m, negative inside; from other surfaces their distance.
template <int D, class P> double body_distance(const Surface<D>& s, const P& x) {
  if (!s.obstacle) return distance(s, x);
  double outside = 0, deepest = -unbounded;
  const auto consider = [&](double beyond) {
    outside += beyond > 0 ? beyond * beyond : 0;
    deepest = std::max(deepest, beyond);
  };
  if (D == 3 && s.radius > 0) consider(std::hypot(x[0] - s.center[0], x[1] - s.center[1]) - s.radius);
  for (int a = D == 3 && s.radius > 0 ? D - 1 : 0; a < D; ++a)
    consider(std::max(s.lower[a] - x[a], x[a] - s.upper[a]));
  return deepest > 0 ? std::sqrt(outside) : deepest;
}

/// Direction in which that distance grows fastest.
template <int D, class P> Point<D> body_normal(const Surface<D>& s, const P& x) {
  if (!s.obstacle) return normal_of(s, x);
  constexpr double small = 1e-7; // m
  Point<D> n{};
  double square = 0;
  for (int a = 0; a < D; ++a) {
    auto ahead = x, behind = x;
    ahead[a] += small;
    behind[a] -= small;
    n[a] = (body_distance(s, ahead) - body_distance(s, behind)) / (2 * small);
    square += n[a] * n[a];
  }
  if (square > 0)
    for (double& component : n) component /= std::sqrt(square);
  return n;
}

/// True at heights where a shell is.
template <int D, class P> bool beside_shell(const Surface<D>& s, const P& x) {
  return !s.shell || (x[D - 1] >= s.lower[D - 1] && x[D - 1] <= s.upper[D - 1]);
}

} // namespace host
