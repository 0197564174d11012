// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/contact.hpp"

namespace host {
namespace {

/// Stops a particle that is nearer to surface number `s` than `gap_kept`; false if nothing was to do.
template <int D> bool touch(const WallsOfStep<D>& walls, int s, double gap_kept, MovingParticle<D>& p) {
  const auto& surface = walls.after[s];
  double d = body_distance(surface, p.position), side = 1;
  if (surface.extent == Extent::shell) {
    if (!beside(surface, p.position)) return false;
    if (distance(walls.before[s], p.start) < 0) side = -1; // sand on the other side stays there
  }
  const double missing = gap_kept - side * d;
  if (!(missing > 1e-9 * gap_kept)) return false;
  auto n = body_normal(surface, p.position);
  for (double& component : n) component *= side;
  const double energy = p.kinetic_energy(), height = p.position[D - 1];
  add_scaled(p.position, missing, n);
  Vector<D> relative = p.velocity, change{};
  add_scaled(relative, -1, surface.velocity);
  const double stopped = std::max(-dot(relative, n), 0.0);
  add_scaled(change, stopped, n);
  add_scaled(p.velocity, stopped, n);
  ++p.work.guarded;
  const double lifting = p.mass * walls.gravity * (p.position[D - 1] - height);
  const double stop_work = p.kinetic_energy() - energy + lifting;
  p.work.wall += stop_work;
  if (surface.is_symmetry()) return true;
  add_scaled(change, 1, apply_friction(walls.walls[surface.wall], surface, n, stopped, p.velocity));
  const double work = p.kinetic_energy() - energy + lifting;
  p.work.friction += work - stop_work;
  add_load(p, surface, n, change, change, work);
  return true;
}

/// True if an earlier one of the surfaces within reach is a side of the same body.
template <int D> bool body_is_done(const WallsOfStep<D>& walls, std::size_t k) {
  const auto& surface = walls.after[walls.within_reach[k]];
  return k > 0 && surface.extent == Extent::body &&
         walls.after[walls.within_reach[k - 1]].wall == surface.wall;
}

} // namespace

template <int D> void keep_off_walls(const WallsOfStep<D>& walls, MovingParticle<D>& p) {
  constexpr int turns = 4; // in a corner one surface may move the particle towards another
  bool again = true;
  for (int turn = 0; again && turn < turns; ++turn) {
    again = false;
    for (std::size_t k = 0; k < walls.within_reach.size(); ++k) {
      const int s = walls.within_reach[k];
      const double gap_kept = (walls.after[s].is_symmetry() ? axis_gap : contact_gap) * walls.spacing;
      if (!body_is_done(walls, k)) again |= touch(walls, s, gap_kept, p);
    }
  }
}

template decltype(keep_off_walls<2>) keep_off_walls<2>;
template decltype(keep_off_walls<3>) keep_off_walls<3>;

} // namespace host
