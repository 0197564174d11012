// SPDX-License-Identifier: BSD-3-Clause
// The push of wall images on a particle that is near several surfaces, taken apart: the sums of host/engine/momentum.cpp hold
// all walls together. Images in one surface push for that surface, though not only across it (they carry stress along
// the wall as the sand does, with a sum of zero over the wall); images of images, which fill corners, push for both.
#pragma once
#include "host/engine/momentum.hpp"
#include "host/engine/simulation.hpp"

namespace host {

/// Splits the push on particle `i` between `near`, numbers of surfaces.
template <class Geometry>
void split_push(const Simulation<Geometry>& simulation, int i, const std::vector<int>& near,
                SplitPush<Geometry::dimension>& push);

} // namespace host
