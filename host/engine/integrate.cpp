// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/integrate.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>

namespace host {
namespace {

/// Slows the horizontal part of `v` down by friction, for a normal change of velocity of `normal`: at most to a
/// stop. Returns the change.
template <int D> std::array<double, D - 1> rub(const Floor& floor, double normal, double (&v)[D]) {
  std::array<double, D - 1> change{};
  double speed = std::abs(v[0]);
  if constexpr (D == 3) speed = std::hypot(v[0], v[1]);
  if (speed == 0) return change;
  const double most = floor.no_slip ? speed : floor.friction * std::max(normal, 0.0);
  for (int a = 0; a < D - 1; ++a) {
    change[a] = -(v[a] / speed) * std::min(most, speed);
    v[a] += change[a];
  }
  return change;
}

/// True if the particle, now at `from`, is on the side of the mirror where the mirror acts.
template <int D> bool faces(const Mirror& mirror, const double (&from)[D], const double (&to)[D]) {
  return !ends_below<D>(mirror) || (depth_behind(mirror, from) >= 0 && to[D - 1] >= mirror.lower_edge);
}

/// Keeps `x` at least `gap` away from the mirror and stops `v` towards it; false if nothing was to do.
template <int D> bool hold_back(const Mirror& mirror, double gap, double (&x)[D], double (&v)[D]) {
  if (depth_behind(mirror, x) >= gap) return false;
  if (mirror.cylinder()) {
    const auto n = normal_at<D>(mirror, x);
    const double towards = n[0] * v[0] + n[1] * v[1];
    for (int a = 0; a < 2; ++a) {
      x[a] = -n[a] * (mirror.position - gap);
      if (towards < 0) v[a] -= towards * n[a];
    }
    return true;
  }
  const int a = mirror.axis;
  const double side = mirror.positive_side ? 1 : -1;
  x[a] = mirror.position + side * gap;
  if (side * v[a] < 0) v[a] = 0;
  return true;
}

template <int D> double half_square(const double (&v)[D]) {
  double sum = 0;
  for (const double component : v) sum += 0.5 * component * component;
  return sum;
}

/// Adds what a wall of normal `n` took up when it changed a velocity.
template <int D>
void book(WallLoad& load, const std::array<double, D>& n, double mass, const double (&before)[D],
          const double (&after)[D], double work) {
  for (int a = 0; a < D; ++a) {
    const double impulse = mass * (after[a] - before[a]);
    load.impulse[a] -= impulse;
    load.normal += n[a] * impulse;
  }
  load.work += work;
}

/// The contact of one particle (from `from` to `x` at `v`) with all mirrors, booked in `work`.
template <int D>
void touch_walls(const Scene& scene, const std::vector<Mirror>& mirrors, double mass, double dt,
                 const double (&from)[D], double (&x)[D], double (&v)[D], Work& work,
                 std::array<WallLoad, 2>& load) {
  constexpr int up = D - 1;
  for (const Mirror& mirror : mirrors) {
    const double height = x[up], energy = half_square(v), falling = v[up];
    double old[D];
    std::copy_n(v, D, old);
    if (!faces(mirror, from, x)) continue;
    if (!hold_back(mirror, (mirror.wall ? contact_gap : axis_gap) * scene.spacing, x, v)) continue;
    ++work.guarded;
    // The velocity is that of half a step earlier: heights count from where the particle was then.
    work.wall +=
        mass * (half_square(v) - energy + scene.gravity * (x[up] - height - 0.5 * dt * (v[up] - falling)));
    if (!ends_below<D>(mirror)) {
      const double before = half_square(v);
      rub(scene.floor, v[up] - falling, v);
      work.friction += mass * (half_square(v) - before);
    }
    if (mirror.wall)
      book<D>(load[mirror.gate], normal_at<D>(mirror, x), mass, old, v,
              mass * (half_square(v) - energy + scene.gravity * (x[up] - height)));
  }
}

/// The push of the images, whose vertical part is the floor's, and the horizontal one the gate's where it is near.
template <int D>
void book_push(const Mirror* gate, double reach, double mass, const double (&from)[D],
               const double (&push)[D], const std::array<double, D - 1>& friction, const double (&mean)[D],
               std::array<WallLoad, 2>& load) {
  constexpr int up = D - 1;
  const bool at_gate = gate && faces(*gate, from, from) && depth_behind(*gate, from) < reach;
  double none[D]{}, by_floor[D]{}, by_gate[D]{}, floor_work = mean[up] * push[up], gate_work = 0;
  by_floor[up] = push[up];
  for (int a = 0; a < up; ++a) {
    by_floor[a] = friction[a] + (at_gate ? 0 : push[a]);
    by_gate[a] = at_gate ? push[a] : 0;
    floor_work += mean[a] * by_floor[a];
    gate_work += mean[a] * by_gate[a];
  }
  std::array<double, D> upwards{};
  upwards[up] = 1;
  book<D>(load[0], upwards, mass, none, by_floor, mass * floor_work);
  if (at_gate) book<D>(load[1], normal_at<D>(*gate, from), mass, none, by_gate, mass * gate_work);
}

} // namespace

void Work::add(const Work& other) {
  stress += other.stress;
  viscosity += other.viscosity;
  wall += other.wall;
  friction += other.friction;
  guarded += other.guarded;
}

void ClusterMotion::add(const ClusterMotion& other) {
  work.add(other.work);
  for (std::size_t w = 0; w < load.size(); ++w) load[w].add(other.load[w]);
  square = std::max(square, other.square);
}

template <class Geometry>
ClusterMotion move_cluster(Particles<Geometry>& p, const Scene& scene, const std::vector<Mirror>& mirrors,
                           double reach, double dt_before, double dt, const ClusterForces<Geometry>& by,
                           int c) {
  constexpr int D = Geometry::dimension, up = D - 1;
  const double kick = 0.5 * (dt_before + dt);
  const auto gate = std::ranges::find_if(mirrors, &Mirror::gate);
  const Mirror* the_gate = gate == mirrors.end() ? nullptr : &*gate;
  ClusterMotion motion;
  Work& work = motion.work;
  for (int l = 0, i = c * lanes; l < lanes && i < p.count; ++l, ++i) {
    double from[D], x[D], before[D], v[D], push[D], mean[D], square = 0;
    bool pushed = false;
    std::array<double, up> by_friction{};
    for (int a = 0; a < D; ++a) {
      from[a] = p.position[a][i];
      before[a] = p.velocity[a][i];
      v[a] = before[a] +
             kick * (by.stress[a][l] + by.viscous[a][l] + by.wall[a][l] - (a == up ? scene.gravity : 0));
    }
    // Friction goes with the push of the floor, over its reach; without slip the lowest layer stands.
    if (from[up] < (scene.floor.no_slip ? scene.spacing : reach))
      by_friction = rub(scene.floor, kick * by.wall[up][l], v);
    for (int a = 0; a < D; ++a) {
      const double impulse = p.mass[i] * 0.5 * (before[a] + v[a]);
      work.stress += impulse * kick * by.stress[a][l];
      work.viscosity += impulse * kick * by.viscous[a][l];
      push[a] = kick * by.wall[a][l];
      mean[a] = 0.5 * (before[a] + v[a]);
      pushed |= push[a] != 0;
      work.wall += impulse * push[a];
      if (a < up) work.friction += impulse * by_friction[a];
      x[a] = from[a] + dt * v[a];
    }
    if (pushed) book_push<D>(the_gate, reach, p.mass[i], from, push, by_friction, mean, motion.load);
    touch_walls(scene, mirrors, p.mass[i], dt, from, x, v, work, motion.load);
    for (int a = 0; a < D; ++a) {
      square += (x[a] - from[a]) * (x[a] - from[a]);
      p.velocity[a][i] = v[a];
      p.position[a][i] = x[a];
    }
    motion.square = std::max(motion.square, square);
  }
  return motion;
}

template <class Geometry> double kinetic_energy(const Particles<Geometry>& p) {
  double sum = 0;
  for (int i = 0; i < p.count; ++i) {
    double square = 0;
    for (const auto& v : p.velocity) square += v[i] * v[i];
    sum += 0.5 * p.mass[i] * square;
  }
  return sum;
}

template <class Geometry> double potential_energy(const Particles<Geometry>& p, double gravity) {
  double sum = 0;
  for (int i = 0; i < p.count; ++i) sum += p.mass[i] * gravity * p.position[Geometry::dimension - 1][i];
  return sum;
}

template ClusterMotion move_cluster(Particles<PlaneStrain>&, const Scene&, const std::vector<Mirror>&, double,
                                    double, double, const ClusterForces<PlaneStrain>&, int);
template ClusterMotion move_cluster(Particles<Axisymmetric>&, const Scene&, const std::vector<Mirror>&,
                                    double, double, double, const ClusterForces<Axisymmetric>&, int);
template ClusterMotion move_cluster(Particles<ThreeDimensional>&, const Scene&, const std::vector<Mirror>&,
                                    double, double, double, const ClusterForces<ThreeDimensional>&, int);
template double kinetic_energy(const Particles<PlaneStrain>&);
template double kinetic_energy(const Particles<Axisymmetric>&);
template double kinetic_energy(const Particles<ThreeDimensional>&);
template double potential_energy(const Particles<PlaneStrain>&, double);
template double potential_energy(const Particles<Axisymmetric>&, double);
template double potential_energy(const Particles<ThreeDimensional>&, double);

} // namespace host
