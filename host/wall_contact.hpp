// SPDX-License-Identifier: BSD-3-Clause
// Kick and drift among walls: what `integrate` is for floor and gate. The push of the images on a particle is shared
// out between the walls near it; friction goes with each share, contact stops what comes nearer than the gap.
#pragma once
#include "host/integrate.hpp"
#include "host/surfaces.hpp"

namespace host {

/// Walls and where their surfaces are before and after the step.
template <int D> struct WallsInStep {
  const std::vector<Wall>& walls;
  const std::vector<Surface<D>>&now, &ahead;
};

/// Shares the change of velocity `push` out along the unit normals, none of them pulling: non-negative least
/// squares. What is left over is returned.
template <int D>
Point<D> share_out(const Point<D>& push, const std::vector<Point<D>>& normals, std::vector<double>& shares);

/// As `integrate`; adds to `loads`, one for each wall, what they took up.
template <class Geometry>
Work integrate_among_walls(Particles<Geometry>& particles, const Scene& scene,
                           const WallsInStep<Geometry::dimension>& walls, int symmetry_planes, double reach,
                           double dt_before, double dt, std::vector<WallLoad>& loads);

} // namespace host
