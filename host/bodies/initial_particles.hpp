// SPDX-License-Identifier: BSD-3-Clause
// The particles of a scene at its start: its body filled with particles in geostatic equilibrium, and put in its place.
// A new shape of body is a function that returns cells (host/bodies/cells.hpp).
#pragma once
#include "host/engine/particles.hpp"
#include "host/scene.hpp"

namespace host {

/// The particles at rest: vertical stress from the weight above, horizontal stress by `earth_pressure_ratio`, state
/// variables as given. Throws std::runtime_error as fill_column does.
template <class Geometry> Particles<Geometry> initial_particles(const Scene& scene);

} // namespace host
