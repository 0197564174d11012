// SPDX-License-Identifier: BSD-3-Clause
// A disc of equal particles, for the layers of a three-dimensional column: concentric rings, then evened out until
// no particle is pushed by a uniform stress. A quarter is made; symmetry gives the rest.
#pragma once
#include <array>
#include <vector>

namespace host {

/// Particles of each of `rings` rings in a quarter of the circle, from the axis outwards. Ring edges enclose whole
/// numbers of equal areas and lie about one of `rings` parts of the radius apart.
std::vector<int> ring_quarters(int rings);

/// Places x, y > 0 of the particles in a quarter of a disc of radius `rings`, in spacings, in the order of the rings.
/// `smoothing_length` in spacings.
std::vector<std::array<double, 2>> quarter_disc(int rings, double smoothing_length);

} // namespace host
