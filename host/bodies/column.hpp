// SPDX-License-Identifier: BSD-3-Clause
// A column: the body of a scene. It is filled with a lattice of particles, square in the plane. In three dimensions the
// layers of a cylinder are discs of concentric rings (host/bodies/disc.hpp), so that the lattice follows the wall and
// shows the plane of symmetry r, z of the same column in axisymmetry.
#pragma once
#include "host/bodies/cells.hpp"

namespace host {

/// A column of radius (plane strain: half width) `radius` whose base is at height 0, symmetric about the axis at
/// coordinate 0, unless it is placed elsewhere.
struct Column {
  double radius = 0; ///< m
  double height = 0; ///< m
  double depth = 0;  ///< m, three dimensions: half width along y of a cuboid, `radius` along x; 0: a cylinder
  std::array<double, 2> center{}; ///< m, horizontal place of the middle of its base
  double base = 0;                ///< m, height of the middle of its base
  double tilt = 0;                ///< degrees, turned about that point from x towards z
  bool placed() const { return center[0] != 0 || center[1] != 0 || base != 0 || tilt != 0; }
};

/// How finely a body is filled.
struct Resolution {
  double spacing = 0;          ///< m, between particles
  double smoothing_length = 0; ///< in spacings
  double skin = 0;             ///< of the neighbour lists, in spacings
  int planes_of_symmetry = 0;  ///< x = 0, then y = 0: only positive coordinates are filled
};

/// Cells that fill the column exactly, in layers from its base, before it is placed: the spacing is rounded to whole
/// numbers of particles, those outside stand half a spacing away from axis, wall and floor. Throws std::runtime_error
/// if the column is thinner or lower than one spacing, in three dimensions if a cylinder is thinner than what a particle
/// reaches, or if there would be more than 1e8 particles.
template <int D> std::vector<Cell<D>> fill_column(const Column& column, const Resolution& resolution);

} // namespace host
