// SPDX-License-Identifier: BSD-3-Clause
// Contact: a particle that would come nearer to a wall than a gap stays there, loses its speed towards it, relative to
// the wall, and as much of its sliding as friction takes for that impulse.
#pragma once
#include "host/walls/near_walls.hpp"

namespace host {

/// Distance, in spacings, at which a particle touches a wall: somewhat less than the half spacing at which
/// lattices start, so that a resting layer is carried by the images' stress alone.
inline constexpr double contact_gap = 0.4;
/// The same for the axis: a ring much narrower than half a spacing is stiff, and its section much larger than a particle.
inline constexpr double axis_gap = 0.4;

/// Keeps a particle that has drifted away from all walls and on its side of planes of symmetry; adds the work.
template <int D> void keep_off_walls(const WallsOfStep<D>& walls, MovingParticle<D>& particle);

} // namespace host
