// SPDX-License-Identifier: BSD-3-Clause
// Bounds that a sound step keeps by far. Beyond them the motion is numbers, not sand, and the run ends.
#pragma once
#include "host/stress.hpp"
#include <stdexcept>

namespace host {

/// Largest component of the velocity gradient times the step that is accepted. Collapses of columns, a = 0.5 to
/// 10, stay below a tenth of it, grains in flight included.
inline constexpr double largest_strain_step = 0.05;
/// Largest kinetic and potential energy beyond that of the start and what walls put in, and largest error of the
/// energy balance; over the initial potential energy. Collapses stay at 0 and below 0.0006.
inline constexpr double largest_made_energy = 0.02, largest_unclosed_energy = 0.005;

struct UnsoundMotion : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws UnsoundMotion naming particle, place, time and strain if a particle deforms or turns by more in
/// this step, or by what is not a number: of the `count` particles first, first + 1, ...
template <class Geometry>
void check_strain(const Particles<Geometry>& particles, const BlockGradient<Geometry>& gradient, int first,
                  int count, double time, double dt);

/// Throws std::runtime_error naming the fastest particle and the time if either energy, over the initial potential
/// energy, is larger than accepted or not a number.
template <class Geometry>
void check_energy(const Particles<Geometry>& particles, double time, double made, double unclosed);

} // namespace host
