// SPDX-License-Identifier: BSD-3-Clause
// The column at its start: a lattice of particles in geostatic equilibrium. In the plane it is square. In
// three dimensions each layer is a disc of concentric rings (host/bodies/disc.hpp), so that the lattice follows the
// cylindrical wall and shows the plane of symmetry r, z of the same column in axisymmetry.
#pragma once
#include "host/engine/particles.hpp"
#include "host/scene.hpp"

namespace host {

/// Particles of `scene.spacing` that fill the column, half a spacing away from axis, wall and floor;
/// vertical stress from the weight above, horizontal stress by `earth_pressure_ratio`; state variables as given.
/// Throws std::runtime_error if the column is thinner or lower than one spacing, in three dimensions thinner
/// than what a particle reaches.
template <class Geometry> Particles<Geometry> make_column(const Scene& scene);

} // namespace host
