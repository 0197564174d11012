// SPDX-License-Identifier: BSD-3-Clause
// Stress of all particles by the material: strain increment and spin from the velocity gradient, old
// stress turned with the material, the VUMAT called in blocks, the answer checked.
#pragma once
#include "host/engine/particles.hpp"
#include "host/engine/records.hpp"
#include "host/scene.hpp"

namespace host {

/// Velocity gradients of the particles of a block, 1/s, component a * D + b of particle k at [a * D + b][k].
template <class Geometry> struct BlockGradient {
  static constexpr int points = 64; ///< per block, fixed: results may not depend on the threads
  alignas(sizeof(Lane)) double component[Geometry::dimension * Geometry::dimension][points];
};

/// One block for each thread and one for the particles left over, allocated once.
struct StressBlocks {
  static constexpr int points = 64; ///< per call
  int failure_state = -1;           ///< position in STATEV that is negative after a failed update; -1: none
  double spacing = 0;               ///< m, the characteristic length of a particle
  double loosest = 0; ///< kg/m3, below it a particle that bears nothing is strained no further apart
  std::vector<VumatBlock> full, tail;
  double tolerance = 0;         ///< relative change of stress up to which a wave speed is kept; 0: none is
  std::vector<int> due;         ///< particles whose wave speed is asked for in this step
  std::vector<double> steepest; ///< 1/s, for each block the largest component of its velocity gradients
};

template <class Geometry>
StressBlocks make_stress_blocks(const Material& material, const Particles<Geometry>& particles,
                                double spacing);

/// Failures of a pass over all particles: the one of the particle that comes first is reported.
struct Failure;

/// Advances stress, state, energies and density of the particles first, first + 1, ... of `block` over `increment`.
/// Old stress is turned by the spin of the step (exactly, so a rigid rotation leaves no error); the material
/// sees strain in the turned frame, which serves isotropic materials. Notes a number that is not finite.
template <class Geometry>
void advance_stress(Particles<Geometry>& particles, const Material& material, const Increment& increment,
                    const StressBlocks& blocks, const BlockGradient<Geometry>& gradient, int first,
                    VumatBlock& block, Failure& failure);

/// Elastic wave speed of each particle, sqrt(constrained modulus / density), m/s: the material's answer
/// to a small uniaxial compression in a data check with current stress and state, which it does not keep. With
/// a tolerance and from the second step on, only of the particles whose stress has changed by it since they were
/// last asked, and of each at least every sixteenth step.
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
