// SPDX-License-Identifier: BSD-3-Clause
// What a neighbour shows to a cluster of eight, one compact record for each of the two pair loops, so
// that a pair is broadcasts from one or two cache lines. Particles come first, in the order of the
// particle arrays; their mirror images follow.
#pragma once
#include "host/geometry.hpp"
#include "host/particles.hpp"

namespace host {

/// For the velocity gradient.
template <int D> struct MotionRecord {
  double position[D]; ///< m
  double velocity[D]; ///< m/s
  double volume;      ///< m3 in 3-D, area m2 in the plane of a 2-D geometry
};

/// For the accelerations.
template <class Geometry> struct StressRecord {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;
  double position[D];
  double velocity[D];
  double volume;
  double weight;            ///< r in axisymmetry, signed: negative across the axis
  double density;           ///< kg/m3
  double damping_speed;     ///< m/s, of the artificial viscosity
  double flux[S];           ///< weight * stress, Pa (or Pa m)
  double gradient[D * D];   ///< of velocity, 1/s
  double reduced_stress[S]; ///< stress less the geostatic part, Pa; what diffusion acts on
};

/// The same in three dimensions: no weight, and of the velocity gradient only what the viscosity needs.
template <> struct StressRecord<ThreeDimensional> {
  double position[3];
  double velocity[3];
  double volume;
  double density;        ///< kg/m3
  double damping_speed;  ///< m/s
  double flux[6];        ///< stress, Pa
  double strain_rate[6]; ///< 1/s, in the order of the VUMAT, shear as the sum of both gradients
};

template <class Geometry> struct Records {
  std::vector<MotionRecord<Geometry::dimension>> motion;
  std::vector<StressRecord<Geometry>> stress;
};

} // namespace host
