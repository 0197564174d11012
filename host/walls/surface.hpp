// SPDX-License-Identifier: BSD-3-Clause
// Smooth surfaces that bound the sand: planes of symmetry and the sides of walls, where they are at one time. A plane
// wall is one surface, a box has one for each side, a cylinder its mantle and, where sand is outside, its ends. All
// geometry of a shape is here: distance, normal, reflection, and which part of the surface exists.
#pragma once
#include "host/walls/vector.hpp"
#include "host/walls/wall.hpp"
#include <algorithm>
#include <cmath>

namespace host {

/// What part of a plane or mantle exists.
enum class Extent {
  whole, ///< all of it
  body,  ///< the side of a body [lower, upper] that has sand all around
  shell  ///< without thickness, between a lower and an upper height
};

template <int D> struct Surface {
  static constexpr int no_wall = -1, oblique = -1;
  int wall = no_wall;          ///< position in the list of walls; no_wall: a plane of symmetry
  bool no_slip = false;        ///< of that wall
  bool mantle = false;         ///< of a cylinder about a vertical axis; else a plane
  int axis = oblique;          ///< plane: the coordinate axis that its normal is along, if any
  Vector<D> point{}, normal{}; ///< plane: a point of it, unit normal towards the sand
  double radius = 0,
         side = 1;    ///< mantle, and any side of a vertical cylinder; side 1: sand outside, -1: inside
  Vector<D> center{}; ///< mantle: of its axis
  Extent extent = Extent::whole;
  Vector<D> lower{}, upper{}; ///< m, of a body, or heights of a shell
  Vector<D> velocity{};       ///< m/s, mean of the step

  bool is_symmetry() const { return wall == no_wall; }
};

/// Distance from the vertical axis at `center`, m. (A few times faster than std::hypot, which guards against overflow.)
template <int D, class P> double axis_distance(const Surface<D>& s, const P& x) {
  const double dx = x[0] - s.center[0], dy = x[1] - s.center[1];
  return std::sqrt(dx * dx + dy * dy);
}

/// Distance from the plane or mantle without end, m, positive on the side of the sand.
template <int D, class P> double distance(const Surface<D>& s, const P& x) {
  if (s.mantle) return s.side * (axis_distance(s, x) - s.radius);
  double sum = 0;
  for (int a = 0; a < D; ++a) sum += (x[a] - s.point[a]) * s.normal[a];
  return sum;
}

/// Unit normal towards the sand at x; on the axis of a mantle the direction of the first coordinate.
template <int D, class P> Vector<D> normal_of(const Surface<D>& s, const P& x) {
  if (!s.mantle) return s.normal;
  Vector<D> n{};
  const double r = axis_distance(s, x);
  n[0] = s.side * (r > 0 ? (x[0] - s.center[0]) / r : 1);
  n[1] = s.side * (r > 0 ? (x[1] - s.center[1]) / r : 0);
  return n;
}

/// Reflects x in the surface, at a mantle in its tangent plane. Returns the ratio of the image's volume to that of the
/// particle: at a mantle the image is on a longer or shorter circle.
template <int D, class P> double reflect(const Surface<D>& s, P& x) {
  if (!s.mantle) {
    const double twice = 2 * distance(s, x);
    for (int a = 0; a < D; ++a) x[a] -= twice * s.normal[a];
    return 1;
  }
  const double r = axis_distance(s, x), stretch = r > 0 ? (2 * s.radius - r) / r : 0;
  for (int a = 0; a < 2; ++a) x[a] = s.center[a] + stretch * (x[a] - s.center[a]);
  return std::max(stretch, 0.0);
}

/// Signed distance from the body that the surface is a side of, m, negative inside; of other surfaces their distance.
template <int D, class P> double body_distance(const Surface<D>& s, const P& x) {
  if (s.extent != Extent::body) return distance(s, x);
  double outside = 0, deepest = -unbounded;
  const auto consider = [&](double beyond) {
    outside += beyond > 0 ? beyond * beyond : 0;
    deepest = std::max(deepest, beyond);
  };
  const bool round = D == 3 && s.radius > 0;
  if (round) consider(axis_distance(s, x) - s.radius);
  for (int a = round ? D - 1 : 0; a < D; ++a) consider(std::max(s.lower[a] - x[a], x[a] - s.upper[a]));
  return deepest > 0 ? std::sqrt(outside) : deepest;
}

/// Direction in which that distance grows fastest.
template <int D, class P> Vector<D> body_normal(const Surface<D>& s, const P& x) {
  if (s.extent != Extent::body) return normal_of(s, x);
  constexpr double small = 1e-7; // m
  Vector<D> n{};
  for (int a = 0; a < D; ++a) {
    auto ahead = x, behind = x;
    ahead[a] += small;
    behind[a] -= small;
    n[a] = (body_distance(s, ahead) - body_distance(s, behind)) / (2 * small);
  }
  const double length = std::sqrt(dot(n, n));
  if (length > 0)
    for (double& component : n) component /= length;
  return n;
}

/// By how much x is above or below a shell, m; 0 beside it and for all other surfaces.
template <int D, class P> double beyond_edge(const Surface<D>& s, const P& x) {
  if (s.extent != Extent::shell) return 0;
  return std::max({s.lower[D - 1] - x[D - 1], x[D - 1] - s.upper[D - 1], 0.0});
}

/// True at heights where a shell is, and for all other surfaces.
template <int D, class P> bool beside(const Surface<D>& s, const P& x) {
  return beyond_edge(s, x) == 0;
}

/// Distance from the part that exists, m, from either side of a shell.
template <int D, class P> double gap(const Surface<D>& s, const P& x) {
  if (s.extent != Extent::shell) return std::abs(body_distance(s, x));
  return std::hypot(distance(s, x), beyond_edge(s, x));
}

} // namespace host
