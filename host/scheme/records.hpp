// SPDX-License-Identifier: BSD-3-Clause
// A neighbour as the pair functions read it: one compact record for each of the two pair loops, so that a pair is
// broadcasts from one or two cache lines.
#pragma once
#include "host/scheme/geometry.hpp"

namespace host {

/// For the velocity gradient.
template <int D> struct MotionRecord {
  double position[D]; ///< m
  double velocity[D]; ///< m/s
  double volume;      ///< m3 in 3-D, area m2 in the plane of a 2-D geometry
};

/// What the accelerations need in addition. Numbers that only the viscosity reads are in single precision.
template <class Geometry> struct StressRecord {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  double stress[S]; ///< Pa
  /// Of the coordinates, 1/s, in the order of the VUMAT, shear as the sum of both gradients.
  float strain_rate[D * (D + 1) / 2];
  float density;       ///< kg/m3
  float damping_speed; ///< m/s, of the artificial viscosity
};

} // namespace host
