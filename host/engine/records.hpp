// SPDX-License-Identifier: BSD-3-Clause
// The records that neighbours read. Particles come first, in the order of the particle arrays; their images follow.
#pragma once
#include "host/engine/particles.hpp"
#include "host/scheme/records.hpp"

namespace host {

template <class Geometry> struct Records {
  std::vector<MotionRecord<Geometry::dimension>> motion;
  std::vector<StressRecord<Geometry>> stress;
};

} // namespace host
