// SPDX-License-Identifier: BSD-3-Clause
// Particles in the frame of Green and Naghdi, for materials that need it (Frame::green_naghdi). Particles keep F and
// their stress in base axes; the material gets them in corotational axes.
#pragma once
#include "host/engine/particles.hpp"
#include "host/engine/stress.hpp"
#include "host/material/block.hpp"

namespace host {

/// Adds a deformation gradient, the identity, to the particles.
template <class Geometry> void carry_deformation(Particles<Geometry>& particles);

/// Rotates strain increment and old stress of a block, set in base axes for particles first, first + 1, ..., to
/// corotational axes, and sets F and U of both ends and the spin, which is that of the velocity gradients over `dt`, s
/// (0 in a data check).
template <class Geometry>
void enter_corotational(const Particles<Geometry>& particles, const BlockGradient<Geometry>& gradient,
                        int first, double dt, VumatBlock& block);

/// Rotates the new stress to base axes.
void leave_corotational(VumatBlock& block);

/// Takes over F of the end of the increment.
template <class Geometry>
void keep_deformation(const VumatBlock& block, int first, Particles<Geometry>& particles);

} // namespace host
