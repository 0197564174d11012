// SPDX-License-Identifier: BSD-3-Clause
#include "host/wall_contact.hpp"
#include "host/geometry.hpp"
#include <algorithm>

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

struct Reach {
  int planes;    ///< of symmetry
  double images; ///< m, of the images
};

struct Times {
  double kick, dt; ///< s, over which velocity and position change
};

/// One particle on its way through the step.
template <int D> struct Traveller {
  double mass;
  Point<D> from, x, before, v;
  Work& work;
  std::vector<WallLoad>& loads;

  double energy() const { return 0.5 * mass * dot(v, v); }
};

/// Books a change of velocity by a wall, along `n` and across.
template <int D>
void book(Traveller<D>& t, int wall, const Point<D>& n, const Point<D>& change, double work_on_sand) {
  auto& load = t.loads[wall];
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

/// The surfaces near a particle, and what each does to its velocity; storage that serves many particles.
template <int D> struct Pushes {
  std::vector<const Surface<D>*> surface;
  std::vector<double> distance, shares;
  std::vector<Point<D>> normal, change;

  void find(const std::vector<Surface<D>>& surfaces, const Point<D>& x, double reach) {
    surface.clear();
    distance.clear();
    normal.clear();
    for (const auto& s : surfaces) {
      const double d = host::distance(s, x);
      if (d < 0 || d > reach || !beside_shell(s, x)) continue;
      if (s.obstacle && body_distance(s, x) > reach) continue;
      surface.push_back(&s);
      distance.push_back(d);
      normal.push_back(normal_of(s, x));
    }
  }
};

/// Shares `push`, a change of velocity already made, out between the walls and adds the friction of each share, the
/// sum of which is returned.
template <int D>
Point<D> feel_push(const WallsInStep<D>& walls, const Point<D>& push, double spacing, Traveller<D>& t,
                   Pushes<D>& near) {
  Point<D> friction{};
  const auto rest = share_out<D>(push, near.normal, near.shares);
  const auto nearest = std::ranges::min_element(near.distance) - near.distance.begin();
  near.change.assign(near.surface.size(), {});
  for (std::size_t k = 0; k < near.surface.size(); ++k) {
    const auto& s = *near.surface[k];
    const Wall& wall = walls.walls[s.wall];
    Point<D> rubbed{};
    // Without slip the lowest layer stands.
    if (!wall.no_slip || near.distance[k] < spacing)
      rubbed = rub(wall, s, near.normal[k], near.shares[k], t.v);
    add_to(friction, 1, rubbed);
    add_to(near.change[k], near.shares[k], near.normal[k]);
    add_to(near.change[k], 1, rubbed);
    if (long(k) == nearest) add_to(near.change[k], 1, rest);
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
  book(t, surface.wall, n, change, all);
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

template <class Geometry, int D = Geometry::dimension>
void move(Particles<Geometry>& p, int i, const Scene& scene, const WallsInStep<D>& walls, const Reach& reach,
          const Times& step, Work& work, std::vector<WallLoad>& loads, Pushes<D>& near) {
  Traveller<D> t{p.mass[i], {}, {}, {}, {}, work, loads};
  Point<D> push, friction{};
  for (int a = 0; a < D; ++a) {
    t.from[a] = p.position[a][i];
    t.before[a] = p.velocity[a][i];
    push[a] = step.kick * p.wall_acceleration[a][i];
    t.v[a] = t.before[a] + step.kick * (p.stress_acceleration[a][i] + p.viscous_acceleration[a][i] +
                                        p.wall_acceleration[a][i] - (a == D - 1 ? scene.gravity : 0));
  }
  near.find(walls.now, t.from, reach.images);
  if (!near.surface.empty()) friction = feel_push(walls, push, scene.spacing, t, near);
  Point<D> impulse;
  for (int a = 0; a < D; ++a) {
    impulse[a] = t.mass * 0.5 * (t.before[a] + t.v[a]);
    work.stress += impulse[a] * step.kick * p.stress_acceleration[a][i];
    work.viscosity += impulse[a] * step.kick * p.viscous_acceleration[a][i];
    work.wall += impulse[a] * push[a];
    work.friction += impulse[a] * friction[a];
    t.x[a] = t.from[a] + step.dt * t.v[a];
  }
  for (std::size_t k = 0; k < near.surface.size(); ++k)
    book(t, near.surface[k]->wall, near.normal[k], near.change[k], dot(impulse, near.change[k]));
  touch_all(walls, reach.planes, scene, t);
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

template <class Geometry>
Work integrate_among_walls(Particles<Geometry>& p, const Scene& scene,
                           const WallsInStep<Geometry::dimension>& walls, int symmetry_planes, double reach,
                           double dt_before, double dt, std::vector<WallLoad>& loads) {
  // Sums by blocks of particles, then over the blocks in order: the same for any number of threads.
  constexpr int block = 512;
  const int blocks = (p.count + block - 1) / block;
  std::vector<Work> work(blocks);
  std::vector<std::vector<WallLoad>> load(blocks, std::vector<WallLoad>(loads.size()));
#pragma omp parallel
  {
    Pushes<Geometry::dimension> near;
#pragma omp for schedule(static)
    for (int b = 0; b < blocks; ++b)
      for (int i = b * block; i < std::min((b + 1) * block, p.count); ++i)
        move(p, i, scene, walls, {symmetry_planes, reach}, {0.5 * (dt_before + dt), dt}, work[b], load[b],
             near);
  }
  Work all;
  for (int b = 0; b < blocks; ++b) {
    all.add(work[b]);
    for (std::size_t w = 0; w < loads.size(); ++w) loads[w].add(load[b][w]);
  }
  return all;
}

template Point<2> share_out(const Point<2>&, const std::vector<Point<2>>&, std::vector<double>&);
template Point<3> share_out(const Point<3>&, const std::vector<Point<3>>&, std::vector<double>&);
template Work integrate_among_walls(Particles<PlaneStrain>&, const Scene&, const WallsInStep<2>&, int, double,
                                    double, double, std::vector<WallLoad>&);
template Work integrate_among_walls(Particles<Axisymmetric>&, const Scene&, const WallsInStep<2>&, int,
                                    double, double, double, std::vector<WallLoad>&);
template Work integrate_among_walls(Particles<ThreeDimensional>&, const Scene&, const WallsInStep<3>&, int,
                                    double, double, double, std::vector<WallLoad>&);

} // namespace host
