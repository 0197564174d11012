// SPDX-License-Identifier: BSD-3-Clause
// Rigid walls as a scene describes them: plane, cylinder or box, at rest or moving on a prescribed path, smooth,
// with Coulomb friction or without slip. How they act: host/walls/WALLS.md.
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace host {

enum class WallShape { plane, cylinder, box };

/// A vector in the coordinates of the geometry: (x, z), (r, z) or (x, y, z); a third entry of the plane is 0.
using WallVector = std::array<double, 3>;

/// Coordinates beyond this, m, stand for no bound.
inline constexpr double unbounded = 1e9;

/// Piecewise linear velocity between the first and the last time; at rest before and after.
struct WallMotion {
  std::vector<double> time;         ///< s, increasing; empty: the wall is fixed
  std::vector<WallVector> velocity; ///< m/s, one for each time

  WallVector displacement(double at) const; ///< m, since time 0
  /// Largest speed(velocity), m/s, between two times, of a function that is convex.
  template <class F> double largest(double from, double to, F&& speed) const {
    double most = 0;
    for (std::size_t k = 0; k + 1 < time.size(); ++k) {
      const double first = std::max(from, time[k]), last = std::min(to, time[k + 1]);
      if (first > last) continue;
      for (const double at : {first, last}) // largest at an end of a straight piece
        most = std::max(most, speed(between(k, at)));
    }
    return most;
  }
  /// Last time at which the wall moves, s; 0 for a fixed one.
  double end() const { return time.empty() ? 0 : time.back(); }
  WallVector between(std::size_t k, double at) const; ///< m/s, in the piece that begins at time[k]
};

struct Wall {
  std::string name;
  WallShape shape = WallShape::plane;
  bool inside = true;           ///< cylinder, box: the sand is inside
  WallVector point{}, normal{}; ///< plane: a point of it, m, and its unit normal towards the sand
  double radius = 0;            ///< cylinder, m; in plane strain half the width between two planes
  WallVector center{};          ///< cylinder: of its vertical axis, m; the last entry is not used
  WallVector lower{}, upper{};  ///< box: corners, m; cylinder: the entry of the height alone
  bool no_slip = false;
  double friction = 0; ///< Coulomb coefficient where slip is allowed
  WallMotion motion;
};

/// What a wall has taken up from the sand since the start, and given to it.
struct WallLoad {
  WallVector impulse{}; ///< N s (plane strain: per metre): force of the sand on the wall, over time
  double normal = 0;    ///< N s, the normal part, summed as a number: pressure times area over time
  double work = 0;      ///< J, done on the sand
  double given =
      0; ///< J, what keeps the wall on its prescribed path has put in: its force times its own motion
  void add(const WallLoad& other) {
    for (int a = 0; a < 3; ++a) impulse[a] += other.impulse[a];
    normal += other.normal;
    work += other.work;
    given += other.given;
  }
};

} // namespace host
