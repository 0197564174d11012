// SPDX-License-Identifier: BSD-3-Clause
// Bounds that a sound step keeps by far. Beyond them the motion is numbers, not sand, and the run ends.
#pragma once
#include "host/engine/stress.hpp"
#include <stdexcept>

namespace host {

struct Work;
template <class Geometry> struct Simulation;

/// Largest component of the velocity gradient times the step that is accepted. Collapses of columns, a = 0.5 to
/// 10, stay below a tenth of it, grains in flight included.
inline constexpr double largest_strain_step = 0.05;
/// Largest kinetic and potential energy beyond that of the start and what walls put in, and largest error of the
/// energy balance; over the initial potential energy. Collapses stay at 0 and below 0.0006.
inline constexpr double largest_made_energy = 0.02, largest_unclosed_energy = 0.005;

/// Largest work that may have been done on the sand, over the initial potential energy, by artificial viscosity, which
/// only takes, and by a wall at rest, whose images without slip give up to 0.008 in sound collapses.
inline constexpr double largest_viscous_gift = 1e-3, largest_wall_gift = 0.03;
/// The same by pairs and walls together, less what moving walls put in. Alone neither tells: at an impact images take what
/// pairs give, and give it back. Sand gives back what it was loaded with, less than a thousandth. A run warns of the first
/// number and ends at the second.
inline constexpr double suspect_pair_gift = 0.01, largest_pair_gift = 0.05;

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

/// Height, m, of the lowest floor: the highest of the horizontal planes and bottoms of boxes that the sand is above,
/// moving ones at their lowest; 0 where there is none, as on a slope.
double lowest_level(const Scene& scene);

/// Potential energy above that height at the start, J: what energies are compared with.
template <class Geometry> double energy_scale(const Simulation<Geometry>& simulation);

/// What moving walls have put in, J. The gate, smooth and upright, gives nothing.
template <class Geometry> double given_by_walls(const Simulation<Geometry>& simulation);

/// Work of pairs and walls, J, that is to be compared with the largest gift: before what walls put in is taken off.
double gift_of_pairs(const Work& work);

/// True if no wall of the scene's list moves.
bool walls_rest(const Scene& scene);

/// Throws std::runtime_error naming what gave the sand more energy than it can, how much, the time and the fastest
/// particle.
template <class Geometry> void check_work(const Simulation<Geometry>& simulation);

} // namespace host
