// SPDX-License-Identifier: BSD-3-Clause
// The walls of a scene, and the surfaces that they and the planes of symmetry are at one time.
#pragma once
#include "host/scene.hpp"
#include "host/walls/surface.hpp"

namespace host {

/// Floor and gate as walls, where the scene has them, then its list of walls. The floor is a horizontal plane at height
/// 0, the gate a smooth tube around the column: a fixed one has no ends, so that it reaches below the floor, one that
/// is lifted begins at height 0 and moves from time 0 on.
std::vector<Wall> all_walls(const Scene& scene);

/// Puts all surfaces at `time`, s, into `list`, planes of symmetry first, with their mean velocity over the `dt` before
/// it (0: velocity 0).
template <int D>
void find_surfaces(int planes_of_symmetry, const std::vector<Wall>& walls, GeometryKind geometry, double time,
                   double dt, std::vector<Surface<D>>& list);

/// Size of the part of a motion (m or m/s) that brings a wall nearer to sand: of a plane across it, of a shell
/// horizontally, of a body all of it.
double part_across(const Wall& wall, int vertical_axis, const WallVector& motion);

} // namespace host
