// SPDX-License-Identifier: BSD-3-Clause
// The step of a simulation as a list of stages.
#pragma once
#include "host/engine/lists.hpp"

namespace host {

/// One step. Throws std::runtime_error if the material fails, a particle strains too much or the step becomes too short.
template <class Geometry> void step(Simulation<Geometry>& simulation);

} // namespace host
