// SPDX-License-Identifier: BSD-3-Clause
// Stress of all particles by the material: strain increment and spin from the velocity gradient, old
// stress turned with the material, the VUMAT called in blocks, the answer checked.
#pragma once
#include "host/particles.hpp"
#include "host/records.hpp"
#include "host/scene.hpp"

namespace host {

/// One block for each thread and one for the particles left over, allocated once.
struct StressBlocks {
  static constexpr int points = 64; ///< per call, fixed: results may not depend on the threads
  int failure_state = -1;           ///< position in STATEV that is negative after a failed update; -1: none
  double spacing = 0;               ///< m, the characteristic length of a particle
  std::vector<VumatBlock> full, tail;
  double tolerance = 0; ///< relative change of stress up to which a wave speed is kept; 0: none is
  std::vector<int> due; ///< particles whose wave speed is asked for in this step
};

template <class Geometry>
StressBlocks make_stress_blocks(const Material& material, const Particles<Geometry>& particles,
                                double spacing);

/// Advances stress, state, energies and density over `increment`. Old stress is turned by the spin of
/// the step (exactly, so a rigid rotation leaves no error) and the stress
/// diffusion of the last step is added; the material sees strain in the turned frame, which serves
/// isotropic materials. Throws std::runtime_error with particle, time, stress and strain increment if
/// the material returns a number that is not finite.
template <class Geometry>
void update_stress(Particles<Geometry>& particles, const Material& material, const Increment& increment,
                   StressBlocks& blocks);

/// Elastic wave speed of each particle, sqrt(constrained modulus / density), m/s: the material's answer
/// to a small uniaxial compression in a data check with current stress and state, which it does not keep. With
/// a tolerance and from the second step on, only of the particles whose stress has changed by it since they were
/// last asked, and of each at least every sixteenth step.
template <class Geometry>
void update_wave_speed(Particles<Geometry>& particles, const Material& material, StressBlocks& blocks,
                       long step = 0);

/// Speed of the artificial viscosity, m/s: alpha c + beta h |grad v|, at most c / 2. The second term damps
/// noise as it arises, by strain; the first, which alone acts in a deposit at rest, is small, for with it
/// the zero-energy modes of the pair sums would hold slopes up that creep down later.
double damping_speed(const Numerics& numerics, double h, double wave_speed, double gradient_norm);

/// Fills `records.stress` of the particles (not of the images). The reduced stress is the stress less its
/// geostatic gradient.
template <class Geometry>
void show_stress(const Particles<Geometry>& particles, const Scene& scene, double smoothing_length,
                 Records<Geometry>& records);

} // namespace host
