// SPDX-License-Identifier: BSD-3-Clause
// The column at its start: a square lattice of particles in geostatic equilibrium.
#pragma once
#include "host/particles.hpp"
#include "host/scene.hpp"

namespace host {

/// Particles of `scene.spacing` that fill the column, half a spacing away from axis, wall and floor;
/// vertical stress from the weight above, horizontal stress by `earth_pressure_ratio`; state variables as given. Throws std::runtime_error if the column is
/// thinner or lower than one spacing.
template <class Geometry> Particles<Geometry> make_column(const Scene& scene);

} // namespace host
