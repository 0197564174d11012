// SPDX-License-Identifier: BSD-3-Clause
// Particles in the frame of Green and Naghdi, for materials that ask for it (Frame::green_naghdi). Particles keep
// F and their stress in base axes; only the material sees the corotational ones.
#pragma once
#include "host/engine/particles.hpp"
#include "host/engine/stress.hpp"
#include "host/material/block.hpp"

namespace host {

/// Gives the particles a deformation gradient, the identity.
template <class Geometry> void carry_deformation(Particles<Geometry>& particles);

/// Turns strain increment and old stress of a block, filled in base axes for particles first, first + 1, ...,
/// and adds F and U of both ends and the spin, which is that of the velocity gradients over `dt`
/// (0 for a strain that is only tried).
template <class Geometry>
void enter_corotational(const Particles<Geometry>& particles, const BlockGradient<Geometry>& gradient,
                        int first, double dt, VumatBlock& block);

/// Turns the new stress back.
void leave_corotational(VumatBlock& block);

/// Keeps F of the end of the increment.
template <class Geometry>
void keep_deformation(const VumatBlock& block, int first, Particles<Geometry>& particles);

} // namespace host
