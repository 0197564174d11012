// SPDX-License-Identifier: BSD-3-Clause
// A particle on its way through a step, and the walls around it.
#pragma once
#include "host/walls/surface.hpp"
#include "host/walls/work.hpp"
#include <span>
#include <vector>

namespace host {

/// The walls, and their surfaces before and after the step. Planes of symmetry come first among the surfaces.
template <int D> struct WallsOfStep {
  const std::vector<Wall>& walls;
  const std::vector<Surface<D>>&before, &after;
  const std::vector<int>& within_reach; ///< numbers of the surfaces that any particle may be near to
  double spacing, gravity;              ///< m, m/s2
};

/// One particle: velocities live at half steps.
template <int D> struct MovingParticle {
  double mass;                ///< kg
  Vector<D> start, position;  ///< m, before and after the step
  Vector<D> before, velocity; ///< m/s, before and after the kick
  Work& work;                 ///< what walls do is added to it
  std::span<WallLoad> loads;  ///< of all walls, likewise

  double kinetic_energy() const { return 0.5 * mass * dot(velocity, velocity); }
};

/// One of the surfaces that push a particle.
template <int D> struct NearSurface {
  const Surface<D>* surface;
  int number;             ///< of the surface
  double distance;        ///< m
  Vector<D> normal;       ///< towards the sand
  Vector<D> push;         ///< m/s, change of velocity by its images in this step, and by friction
  double normal_push = 0; ///< m/s, along the normal, without friction
  Vector<D>
      driven{}; ///< m/s, what of `push` the wall transmits: along the normal, by friction, without slip all
};

/// Adds a change of velocity by a surface to the load of its wall. `driven` is the part that the wall transmits: what a
/// smooth one's images push along it is the sand's own stress, with a sum of zero over the wall.
template <int D>
void add_load(MovingParticle<D>& p, const Surface<D>& surface, const Vector<D>& normal,
              const Vector<D>& change, const Vector<D>& driven, double work_on_sand) {
  WallLoad& load = p.loads[surface.wall];
  load.given += p.mass * dot(driven, surface.velocity);
  for (int a = 0; a < D; ++a) load.impulse[a] -= p.mass * change[a];
  load.normal += p.mass * dot(normal, change);
  load.work += work_on_sand;
}

/// Coulomb friction: slows the motion along the wall down, relative to it, by at most the coefficient times the change
/// `normal_push` of the velocity along the normal, and at most to a stop; without slip to a stop in any case. Returns the
/// change of velocity.
template <int D>
Vector<D> apply_friction(const Wall& wall, const Surface<D>& s, const Vector<D>& normal, double normal_push,
                         Vector<D>& velocity) {
  Vector<D> sliding{}, change{};
  if (!wall.no_slip && !(wall.friction * normal_push > 0)) return change;
  for (int a = 0; a < D; ++a) sliding[a] = velocity[a] - s.velocity[a];
  add_scaled(sliding, -dot(sliding, normal), normal);
  const double speed = std::sqrt(dot(sliding, sliding));
  if (speed == 0) return change;
  const double most = wall.no_slip ? speed : wall.friction * normal_push;
  add_scaled(change, -std::min(most, speed) / speed, sliding);
  add_scaled(velocity, 1, change);
  return change;
}

} // namespace host
