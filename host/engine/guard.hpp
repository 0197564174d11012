// SPDX-License-Identifier: BSD-3-Clause
// Bounds that a sound step keeps by far. A run that exceeds one of them has become unstable, and ends.
#pragma once
#include "host/engine/stress.hpp"
#include <stdexcept>

namespace host {

struct Work;
template <class Geometry> struct Simulation;

/// Largest accepted component of the velocity gradient times the step. Collapses of columns of aspect ratios 0.5 to 10
/// stay below a tenth of it, grains in flight included.
inline constexpr double largest_strain_step = 0.05;
/// Largest gain of kinetic and potential energy since the start, beyond the work of moving walls, and largest error of the
/// energy balance, both over the initial potential energy. In collapses of columns the gain is 0 and the error below 0.0006.
inline constexpr double largest_energy_gain = 0.02, largest_energy_imbalance = 0.005;

/// Largest accepted work on the sand, over the initial potential energy: by artificial viscosity, which should only take
/// energy, and by a wall at rest, whose images without slip add up to 0.008 in sound collapses.
inline constexpr double largest_viscous_gain = 1e-3, largest_wall_gain = 0.03;
/// The same by pairs and walls together, less the work of moving walls. Only the sum can be judged, since at an impact
/// images and pairs exchange energy. Sand returns the elastic energy it was loaded with, which is less than a thousandth. A
/// run warns beyond the first number and ends at the second.
inline constexpr double suspect_pair_gain = 0.01, largest_pair_gain = 0.05;

struct UnstableMotion : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws UnstableMotion naming particle, place, time and strain if one of the `count` particles first, first + 1, ...
/// deforms or turns by more than largest_strain_step in this step, or by a value that is not a number.
template <class Geometry>
void check_strain(const Particles<Geometry>& particles, const BlockGradient<Geometry>& gradient, int first,
                  int count, double time, double dt);

/// Throws std::runtime_error naming the fastest particle and the time if the gain or the imbalance of energy, both over the
/// initial potential energy, is larger than accepted or not a number.
template <class Geometry>
void check_energy(const Particles<Geometry>& particles, double time, double gain, double imbalance);

/// Height, m, below which no sand can be: the highest of floor, horizontal planes and bottoms of boxes, moving ones at
/// their lowest place; 0 if there is none, as on a slope.
double lowest_level(const Scene& scene);

/// Potential energy above that height at the start, J. Gains and errors of energy are compared with it.
template <class Geometry> double energy_scale(const Simulation<Geometry>& simulation);

/// Work of moving walls on the sand since the start, J. The gate, smooth and upright, does none.
template <class Geometry> double given_by_walls(const Simulation<Geometry>& simulation);

/// Work of pairs and walls, J. Less the work of moving walls it is compared with largest_pair_gain.
double pair_work(const Work& work);

/// True if no wall of the scene's list moves.
bool walls_rest(const Scene& scene);

/// Throws std::runtime_error if viscosity, a wall at rest, or pairs and walls together have done more work on the sand
/// than accepted: names the cause, the work, the time and the fastest particle.
template <class Geometry> void check_work(const Simulation<Geometry>& simulation);

} // namespace host
