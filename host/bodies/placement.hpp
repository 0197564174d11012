// SPDX-License-Identifier: BSD-3-Clause
// A column that does not stand upright at the origin: raised, moved aside, tilted.
#pragma once
#include "host/bodies/column.hpp"
#include "host/engine/particles.hpp"

namespace host {

/// Turns the column about the middle of its base, from x towards z, and moves that point to its place. The initial
/// stress turns with it and is that of a layer on a slope: normal stress by the part of gravity across it.
template <class Geometry> void place(const Column& column, Particles<Geometry>& particles);

} // namespace host
