// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/wall_contact.hpp"
#include "host/scheme/geometry.hpp"
#include "host/walls/wall_forces.hpp"
#include <algorithm>
#include <omp.h>
#include <span>

namespace host {
namespace {

template <int D> double dot(const Point<D>& a, const Point<D>& b) {
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += a[c] * b[c];
  return sum;
}

template <int D> void add_to(Point<D>& a, double factor, const Point<D>& b) {
  for (int c = 0; c < D; ++c) a[c] += factor * b[c];
}

/// Walls and where their surfaces are before and after the step.
template <int D> struct WallsInStep {
  const std::vector<Wall>& walls;
  const std::vector<Surface<D>>&now, &ahead;
};

/// One particle on its way through the step.
template <int D> struct Traveller {
  double mass;
  Point<D> from, x, before, v;
  Work& work;
  std::span<WallLoad> loads;

  double energy() const { return 0.5 * mass * dot(v, v); }
};

/// Books a change of velocity by a surface of a wall, along `n` and across.
template <int D>
void book(Traveller<D>& t, const Surface<D>& surface, const Point<D>& n, const Point<D>& change,
          double work_on_sand) {
  auto& load = t.loads[surface.wall];
  load.given += t.mass * dot(change, surface.velocity);
  for (int a = 0; a < D; ++a) load.impulse[a] -= t.mass * change[a];
  load.normal += t.mass * dot(n, change);
  load.work += work_on_sand;
}

/// Slows the motion along the wall down, relative to it, for a normal change of velocity: at most to a stop. Returns
/// the change.
template <int D>
Point<D> rub(const Wall& wall, const Surface<D>& s, const Point<D>& n, double normal, Point<D>& v) {
  Point<D> along{}, change{};
  for (int a = 0; a < D; ++a) along[a] = v[a] - s.velocity[a];
  add_to(along, -dot(along, n), n);
  const double speed = std::sqrt(dot(along, along));
  const double most = wall.no_slip ? speed : wall.friction * std::max(normal, 0.0);
  if (speed == 0 || most == 0) return change;
  add_to(change, -std::min(most, speed) / speed, along);
  add_to(v, 1, change);
  return change;
}

template <int D>
void find_near(const std::vector<Surface<D>>& surfaces, const Point<D>& x, double reach, Pushes<D>& near) {
  near.surface.clear();
  near.number.clear();
  near.distance.clear();
  near.normal.clear();
  for (const auto& s : surfaces) {
    const double d = distance(s, x);
    if (d < 0 || d > reach || !beside_shell(s, x)) continue;
    if (s.obstacle && body_distance(s, x) > reach) continue;
    near.surface.push_back(&s);
    near.number.push_back(int(&s - surfaces.data()));
    near.distance.push_back(d);
    near.normal.push_back(normal_of(s, x));
  }
}

/// Who pushes how much: fills `shares` and `change`, which add up to `push`.
template <class Geometry, int D = Geometry::dimension>
void find_shares(const Simulation<Geometry>& s, int i, double kick, const Point<D>& push, Pushes<D>& near) {
  const std::size_t count = near.surface.size();
  near.change.assign(count, {});
  near.shares.assign(count, 0);
  Point<D> rest = push;
  if (count > 1) {
    split_push(s, i, near.number, near.split);
    Point<D> corners{};
    add_to(corners, kick, near.split.by_corners);
    share_out<D>(corners, near.normal, near.shares);
    for (std::size_t k = 0; k < count; ++k) {
      add_to(near.change[k], near.shares[k], near.normal[k]);
      add_to(near.change[k], kick, near.split.by_surface[k]);
      add_to(rest, -1, near.change[k]);
    }
  }
  const auto nearest = std::ranges::min_element(near.distance) - near.distance.begin();
  add_to(near.change[nearest], 1, rest);
  for (std::size_t k = 0; k < count; ++k) near.shares[k] = dot(near.change[k], near.normal[k]);
}

/// Takes back what would pull, of a `push` already in the velocity: walls do not stick; and adds the friction of each
/// share, the sum of which is returned.
template <int D>
Point<D> feel_push(const WallsInStep<D>& walls, double spacing, Point<D>& push, Traveller<D>& t,
                   Pushes<D>& near) {
  Point<D> friction{};
  for (std::size_t k = 0; k < near.surface.size(); ++k) {
    const double pull = std::min(near.shares[k], 0.0);
    for (auto* vector : {&near.change[k], &push, &t.v}) add_to(*vector, -pull, near.normal[k]);
  }
  for (std::size_t k = 0; k < near.surface.size(); ++k) {
    const auto& s = *near.surface[k];
    const Wall& wall = walls.walls[s.wall];
    // Without slip the lowest layer stands.
    if (wall.no_slip && near.distance[k] >= spacing) continue;
    const auto rubbed = rub(wall, s, near.normal[k], near.shares[k], t.v);
    add_to(friction, 1, rubbed);
    add_to(near.change[k], 1, rubbed);
  }
  return friction;
}

/// Stops a particle that is nearer to surface number `s` than `gap`; false if nothing was to do.
template <int D>
bool touch(const WallsInStep<D>& walls, std::size_t s, double gap, double gravity, Traveller<D>& t) {
  const auto& surface = walls.ahead[s];
  if (!beside_shell(surface, t.x)) return false;
  const double side = surface.shell && distance(walls.now[s], t.from) < 0 ? -1 : 1;
  const double missing = gap - side * body_distance(surface, t.x);
  if (!(missing > 1e-9 * gap)) return false;
  auto n = body_normal(surface, t.x);
  for (double& component : n) component *= side;
  const double energy = t.energy(), height = t.x[D - 1];
  add_to(t.x, missing, n);
  Point<D> relative = t.v;
  add_to(relative, -1, surface.velocity);
  const double stopped = std::max(-dot(relative, n), 0.0);
  Point<D> change{};
  add_to(change, stopped, n);
  add_to(t.v, stopped, n);
  const double stop_work = t.energy() - energy + t.mass * gravity * (t.x[D - 1] - height);
  const auto rubbed = rub(walls.walls[surface.wall], surface, n, stopped, t.v);
  add_to(change, 1, rubbed);
  const double all = t.energy() - energy + t.mass * gravity * (t.x[D - 1] - height);
  ++t.work.guarded;
  t.work.wall += stop_work;
  t.work.friction += all - stop_work;
  book(t, surface, n, change, all);
  return true;
}

/// Keeps planes of symmetry and the axis uncrossed.
template <int D> void stay_on_side(int planes, double gap, Traveller<D>& t) {
  for (int a = 0; a < planes; ++a) {
    if (t.x[a] >= gap) continue;
    const double energy = t.energy();
    t.x[a] = gap;
    t.v[a] = std::max(t.v[a], 0.0);
    ++t.work.guarded;
    t.work.wall += t.energy() - energy;
  }
}

/// Contact with all walls; a corner takes several turns.
template <int D>
void touch_all(const WallsInStep<D>& walls, int planes, const Scene& scene, Traveller<D>& t) {
  constexpr int turns = 4;
  bool again = true;
  for (int turn = 0; again && turn < turns; ++turn) {
    again = false;
    stay_on_side(planes, axis_gap * scene.spacing, t);
    for (std::size_t s = 0; s < walls.ahead.size(); ++s) {
      const bool seen = s > 0 && walls.ahead[s].obstacle && walls.ahead[s - 1].wall == walls.ahead[s].wall;
      if (!seen) again |= touch(walls, s, contact_gap * scene.spacing, scene.gravity, t);
    }
  }
}

/// Particle i, lane l of a cluster under the forces `by`.
template <class Geometry, int D = Geometry::dimension>
void move_one(Simulation<Geometry>& s, int i, const ClusterForces<Geometry>& by, int l,
              const WallsInStep<D>& walls, double kick, ClusterMotion& motion, std::span<WallLoad> loads,
              Pushes<D>& near) {
  auto& p = s.particles;
  Work& work = motion.work;
  Traveller<D> t{p.mass[i], {}, {}, {}, {}, work, loads};
  Point<D> push, friction{};
  for (int a = 0; a < D; ++a) {
    t.from[a] = p.position[a][i];
    t.before[a] = p.velocity[a][i];
    push[a] = kick * by.wall[a][l];
    t.v[a] = t.before[a] +
             kick * (by.stress[a][l] + by.viscous[a][l] + by.wall[a][l] - (a == D - 1 ? s.scene.gravity : 0));
  }
  find_near(walls.now, t.from, s.kernel.support, near);
  if (near.surface.empty()) { // behind an edge; walls out of reach do not push
    add_to(t.v, -1, push);
    push = {};
  } else {
    find_shares(s, i, kick, push, near);
    friction = feel_push(walls, s.scene.spacing, push, t, near);
  }
  Point<D> impulse;
  for (int a = 0; a < D; ++a) {
    impulse[a] = t.mass * 0.5 * (t.before[a] + t.v[a]);
    work.stress += impulse[a] * kick * by.stress[a][l];
    work.viscosity += impulse[a] * kick * by.viscous[a][l];
    work.wall += impulse[a] * push[a];
    work.friction += impulse[a] * friction[a];
    t.x[a] = t.from[a] + s.dt * t.v[a];
  }
  for (std::size_t k = 0; k < near.surface.size(); ++k)
    book(t, *near.surface[k], near.normal[k], near.change[k], dot(impulse, near.change[k]));
  touch_all(walls, int(s.mirrors.size()), s.scene, t);
  Point<D> travel = t.x;
  add_to(travel, -1, t.from);
  motion.square = std::max(motion.square, dot(travel, travel));
  for (int a = 0; a < D; ++a) {
    p.velocity[a][i] = t.v[a];
    p.position[a][i] = t.x[a];
  }
}

} // namespace

template <int D>
Point<D> share_out(const Point<D>& push, const std::vector<Point<D>>& normals, std::vector<double>& shares) {
  constexpr int sweeps = 8;
  Point<D> rest = push;
  shares.assign(normals.size(), 0);
  for (int sweep = 0; sweep < (normals.size() > 1 ? sweeps : 1); ++sweep)
    for (std::size_t k = 0; k < normals.size(); ++k) {
      const double more = std::max(dot(rest, normals[k]), -shares[k]);
      shares[k] += more;
      add_to(rest, -more, normals[k]);
    }
  return rest;
}

template <class Geometry> ClusterMotion move_among_walls(Simulation<Geometry>& s) {
  constexpr int D = Geometry::dimension;
  // Sums by blocks of particles, then over the blocks in order: the same for any number of threads.
  constexpr int together = 64; // clusters
  auto& p = s.particles;
  const int blocks = (p.clusters() + together - 1) / together;
  const std::size_t wall_count = s.loads.size();
  auto& room = s.wall_room;
  find_surfaces(s.walls, s.scene.geometry, s.time + s.dt, s.dt, room.ahead);
  const WallsInStep<D> walls{s.walls, s.surfaces, room.ahead};
  room.pushes.resize(std::size_t(omp_get_max_threads()));
  room.motion.assign(blocks, {});
  room.load.assign(blocks * wall_count, {});
#pragma omp parallel
  {
    auto& near = room.pushes[omp_get_thread_num()];
#pragma omp for schedule(static)
    for (int b = 0; b < blocks; ++b) {
      const auto loads = std::span(room.load).subspan(b * wall_count, wall_count);
      for (int c = b * together; c < std::min((b + 1) * together, p.clusters()); ++c) {
        const auto forces = forces_on(p, s.kernel, s.lists, s.records, medium_of(s.scene), c);
        const int first = c * lanes, used = std::min(lanes, p.count - first);
        for (int l = 0; l < used; ++l)
          move_one(s, first + l, forces, l, walls, 0.5 * (s.dt_before + s.dt), room.motion[b], loads, near);
        for (std::size_t e = 0; e < p.stress.size(); ++e)
          store(&p.stress[e][first], load(&p.stress[e][first]) + s.dt * forces.diffusion[e], used);
      }
    }
  }
  ClusterMotion all;
  for (int b = 0; b < blocks; ++b) {
    all.add(room.motion[b]);
    for (std::size_t w = 0; w < wall_count; ++w) s.loads[w].add(room.load[b * wall_count + w]);
  }
  return all;
}

template Point<2> share_out(const Point<2>&, const std::vector<Point<2>>&, std::vector<double>&);
template Point<3> share_out(const Point<3>&, const std::vector<Point<3>>&, std::vector<double>&);
template ClusterMotion move_among_walls(Simulation<PlaneStrain>&);
template ClusterMotion move_among_walls(Simulation<Axisymmetric>&);
template ClusterMotion move_among_walls(Simulation<ThreeDimensional>&);

} // namespace host
