// SPDX-License-Identifier: BSD-3-Clause
// What a neighbour shows to a cluster of eight, one compact record for each of the two pair loops, so
// that a pair is broadcasts from one or two cache lines. Particles come first, in the order of the
// particle arrays; their mirror images follow.
#pragma once
#include "host/engine/particles.hpp"
#include "host/scheme/geometry.hpp"

namespace host {

/// For the velocity gradient.
template <int D> struct MotionRecord {
  double position[D]; ///< m
  double velocity[D]; ///< m/s
  double volume;      ///< m3 in 3-D, area m2 in the plane of a 2-D geometry
};

/// What the accelerations need beside it. Single precision where only the viscosity, a damping, reads it.
template <class Geometry> struct StressRecord {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  double stress[S]; ///< Pa
  /// Of the coordinates, 1/s, in the order of the VUMAT, shear as the sum of both gradients.
  float strain_rate[D * (D + 1) / 2];
  float density;       ///< kg/m3
  float damping_speed; ///< m/s, of the artificial viscosity
};

template <class Geometry> struct Records {
  std::vector<MotionRecord<Geometry::dimension>> motion;
  std::vector<StressRecord<Geometry>> stress;
};

} // namespace host
