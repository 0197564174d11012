// SPDX-License-Identifier: BSD-3-Clause
// The size of a step.
#pragma once
#include "host/engine/simulation.hpp"

namespace host {

/// Sets `dt`, s, from the current wave speeds, from motion and from walls that come nearer. Throws std::runtime_error
/// if it falls to a thousandth of the first one.
template <class Geometry> void choose_step(Simulation<Geometry>& simulation);

} // namespace host
