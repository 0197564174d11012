// SPDX-License-Identifier: BSD-3-Clause
// Kick and drift among walls: what `integrate` is for floor and gate. The push of the images on a particle is shared
// out between the walls near it; friction goes with each share, contact stops what comes nearer than the gap.
#pragma once
#include "host/engine/simulation.hpp"

namespace host {

/// Shares the change of velocity `push` out along the unit normals, none of them pulling: non-negative least
/// squares. What is left over is returned.
template <int D>
Point<D> share_out(const Point<D>& push, const std::vector<Point<D>>& normals, std::vector<double>& shares);

/// As `move` of host/engine/passes.hpp; adds to the loads of the walls what they took up.
template <class Geometry> ClusterMotion move_among_walls(Simulation<Geometry>& simulation);

} // namespace host
