// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/guard.hpp"
#include "host/engine/simulation.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace host {
namespace {

/// Largest component of the velocity gradient of point k, 1/s; not a number if one of them is not.
template <class Geometry> double largest_component(const BlockGradient<Geometry>& gradient, int k) {
  double largest = 0;
  for (const auto& component : gradient.component) {
    const double slope = std::abs(component[k]);
    if (std::isnan(slope)) return slope;
    largest = std::max(largest, slope);
  }
  return largest;
}

template <class Geometry> double square_speed(const Particles<Geometry>& p, int i) {
  double sum = 0;
  for (const auto& v : p.velocity) sum += v[i] * v[i];
  return sum;
}

/// "particle 7 at (0.1, 0.2) m"
template <class Geometry> std::string describe(const Particles<Geometry>& p, int i) {
  std::vector<double> place;
  for (const auto& x : p.position) place.push_back(x[i]);
  return fmt::format("particle {} at ({:.6g}) m", p.id[i], fmt::join(place, ", "));
}

constexpr auto advice = "a smaller numerics.step_factor may help";

/// "particle 7 at (0.1, 0.2) m with 3 m/s"
template <class Geometry> std::string fastest_of(const Particles<Geometry>& p) {
  int fastest = 0;
  for (int i = 1; i < p.count; ++i)
    if (square_speed(p, i) > square_speed(p, fastest)) fastest = i;
  return fmt::format("{} with {:.3g} m/s", describe(p, fastest), std::sqrt(square_speed(p, fastest)));
}

bool is_fixed(const Wall& wall) {
  return wall.motion.time.empty();
}

/// Lowest vertical displacement of a wall, m.
double lowest_displacement(const WallMotion& motion, int up) {
  double lowest = 0;
  for (const double t : motion.time) lowest = std::min(lowest, motion.displacement(t)[up]);
  return lowest;
}

/// Height of a wall that sand cannot be below, m; minus infinity if it bounds no height.
double bottom_of(const Wall& wall, int up) {
  constexpr double upright = 1 - 1e-12; // a unit normal that points up
  double bottom = -std::numeric_limits<double>::infinity();
  if (wall.shape == WallShape::plane && wall.normal[up] > upright) bottom = wall.point[up];
  if (wall.shape == WallShape::box && wall.inside && wall.lower[up] > -0.5 * unbounded)
    bottom = wall.lower[up];
  return bottom + lowest_displacement(wall.motion, up);
}

} // namespace

template <class Geometry>
void check_strain(const Particles<Geometry>& p, const BlockGradient<Geometry>& gradient, int first, int count,
                  double time, double dt) {
  const double most = largest_strain_step / dt;
  bool sound = true;
  for (const auto& component : gradient.component)
    for (int k = 0; k < count; ++k) sound &= std::abs(component[k]) <= most; // false for NaN
  if (sound) return;
  for (int k = 0; k < count; ++k)
    if (const double strain = largest_component(gradient, k) * dt; !(strain <= largest_strain_step))
      throw UnstableMotion(fmt::format("the motion became unstable at time {:.9g} s: {} strains by {:.3g} in "
                                       "one step of {:.3g} s (at most {} is sound); {}",
                                       time, describe(p, first + k), strain, dt, largest_strain_step,
                                       advice));
}

template <class Geometry>
void check_energy(const Particles<Geometry>& p, double time, double gain, double imbalance) {
  if (gain <= largest_energy_gain && std::abs(imbalance) <= largest_energy_imbalance) return;
  throw std::runtime_error(fmt::format(
      "the energy went wrong at time {:.9g} s: {:.3g} of the initial potential energy was made "
      "from nothing (at most "
      "{}), {:.3g} of it is unaccounted for (at most {}); the fastest is {}; {}",
      time, gain, largest_energy_gain, imbalance, largest_energy_imbalance, fastest_of(p), advice));
}

double lowest_level(const Scene& scene) {
  const int up = scene.geometry == GeometryKind::three_dimensional ? 2 : 1;
  double level = -std::numeric_limits<double>::infinity();
  if (scene.floor.present) level = 0;
  for (const Wall& wall : scene.walls) level = std::max(level, bottom_of(wall, up));
  return std::isfinite(level) ? level : 0;
}

template <class Geometry> double energy_scale(const Simulation<Geometry>& s) {
  double mass = 0;
  for (int i = 0; i < s.particles.count; ++i) mass += s.particles.mass[i];
  return s.initial_potential_energy - mass * s.scene.gravity * lowest_level(s.scene);
}

bool walls_rest(const Scene& scene) {
  return std::ranges::all_of(scene.walls, is_fixed);
}

template <class Geometry> double given_by_walls(const Simulation<Geometry>& s) {
  double given = 0;
  for (const auto& load : s.loads) given += load.given;
  return given;
}

double pair_work(const Work& work) {
  return work.stress + work.wall + work.friction;
}

template <class Geometry> void check_work(const Simulation<Geometry>& s) {
  const double by_walls = given_by_walls(s), scale = energy_scale(s) + std::max(by_walls, 0.0);
  const auto check = [&](const std::string& cause, double work, double most) {
    if (work <= most * scale) return; // false for NaN
    throw std::runtime_error(fmt::format(
        "the energy went wrong at time {:.9g} s: {} gave the sand {:.3g} of the energy that was put in "
        "(at most {} is sound); the fastest is {}; {}",
        s.time, cause, work / scale, most, fastest_of(s.particles), advice));
  };
  check("artificial viscosity", s.work.viscosity, largest_viscous_gain);
  for (std::size_t w = 0; w < s.walls.size(); ++w)
    if (is_fixed(s.walls[w]))
      check(fmt::format("the wall '{}' at rest", s.walls[w].name), s.loads[w].work, largest_wall_gain);
  check("the stress of pairs and walls", pair_work(s.work) - by_walls, largest_pair_gain);
}

template decltype(given_by_walls<PlaneStrain>) given_by_walls<PlaneStrain>;
template decltype(given_by_walls<Axisymmetric>) given_by_walls<Axisymmetric>;
template decltype(given_by_walls<ThreeDimensional>) given_by_walls<ThreeDimensional>;
template decltype(energy_scale<PlaneStrain>) energy_scale<PlaneStrain>;
template decltype(energy_scale<Axisymmetric>) energy_scale<Axisymmetric>;
template decltype(energy_scale<ThreeDimensional>) energy_scale<ThreeDimensional>;
template decltype(check_work<PlaneStrain>) check_work<PlaneStrain>;
template decltype(check_work<Axisymmetric>) check_work<Axisymmetric>;
template decltype(check_work<ThreeDimensional>) check_work<ThreeDimensional>;
template decltype(check_energy<PlaneStrain>) check_energy<PlaneStrain>;
template decltype(check_energy<Axisymmetric>) check_energy<Axisymmetric>;
template decltype(check_energy<ThreeDimensional>) check_energy<ThreeDimensional>;
template decltype(check_strain<PlaneStrain>) check_strain<PlaneStrain>;
template decltype(check_strain<Axisymmetric>) check_strain<Axisymmetric>;
template decltype(check_strain<ThreeDimensional>) check_strain<ThreeDimensional>;

} // namespace host
