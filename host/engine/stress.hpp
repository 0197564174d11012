// SPDX-License-Identifier: BSD-3-Clause
// Stress of particles by the material, in blocks: strain increment and rotation from the velocity gradient, old stress
// rotated with the material, one call of the VUMAT, its results checked.
#pragma once
#include "host/engine/particles.hpp"
#include "host/engine/records.hpp"
#include "host/scene.hpp"

namespace host {

/// Velocity gradients of the particles of a block, 1/s, component a * D + b of particle k at [a * D + b][k].
template <class Geometry> struct BlockGradient {
  static constexpr int points = 64; ///< as in StressBlocks
  alignas(sizeof(Lane)) double component[Geometry::dimension * Geometry::dimension][points];
};

/// One block for each thread and one for the particles left over, allocated once, and what all of them need.
struct StressBlocks {
  static constexpr int points =
      64;                       ///< per call; fixed, so that results do not depend on the number of threads
  int failure_state = -1;       ///< position in STATEV that is negative after a failed update; -1: none
  double spacing = 0;           ///< m, the characteristic length of a particle
  double dispersed_density = 0; ///< kg/m3, below it a particle under no load does not expand any further
  std::vector<VumatBlock> full, tail;
  double wave_speed_tolerance =
      0;                     ///< relative change of stress up to which a wave speed is kept; 0: none is kept
  std::vector<int> outdated; ///< particles whose wave speed is found anew in this step
  std::vector<double>
      largest_gradient; ///< 1/s, for each block the largest component of its velocity gradients
};

template <class Geometry>
StressBlocks make_stress_blocks(const Material& material, const Particles<Geometry>& particles,
                                double spacing);

struct FirstFailure;

/// Advances stress, state, energies and density of the particles first, first + 1, ... of `block` over `increment`.
/// Old stress is rotated by the spin of the step, exactly, so that a rigid rotation leaves no error. The material gets the
/// strain in the axes of the end of the step, which serves isotropic materials; others ask for Frame::green_naghdi. A
/// number that is not finite, or a failure that the material reports, is kept in `failure`.
template <class Geometry>
void advance_stress(Particles<Geometry>& particles, const Material& material, const Increment& increment,
                    const StressBlocks& blocks, const BlockGradient<Geometry>& gradient, int first,
                    VumatBlock& block, FirstFailure& failure);

/// Elastic wave speed of each particle, sqrt(constrained modulus / density), m/s. The modulus is the material's
/// response to a small uniaxial compression in a data check with current stress and state, which keep their values. With a
/// tolerance and from the second step on, it is found for those particles whose stress has changed by more since it was
/// found last, and for each particle at least every sixteenth step. Throws as update_stresses does.
template <class Geometry>
void update_wave_speed(Particles<Geometry>& particles, const Material& material, StressBlocks& blocks,
                       long step = 0);

/// Velocity gradients of a cluster, 1/s.
template <class Geometry> using ClusterGradient = std::array<Lane, Geometry::dimension * Geometry::dimension>;

/// Writes `records.stress` and the diffusivity of stress of the `used` particles first, first + 1, ... of a cluster.
template <class Geometry>
void write_stress_records(Particles<Geometry>& particles, int first, int used,
                          const ClusterGradient<Geometry>& gradient, const Medium& medium,
                          double smoothing_length, Records<Geometry>& records);

} // namespace host
