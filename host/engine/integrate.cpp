// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/integrate.hpp"
#include "host/scheme/geometry.hpp"
#include "host/walls/contact.hpp"
#include <algorithm>
#include <cmath>

namespace host {
namespace {

/// Particle number `l` of a cluster.
template <class Geometry, int D = Geometry::dimension>
MovingParticle<D> particle_of(const MovingCluster<Geometry>& m, int l, Work& work,
                              std::span<WallLoad> loads) {
  MovingParticle<D> p{m.mass[l], {}, {}, {}, {}, work, loads};
  for (int a = 0; a < D; ++a) {
    p.start[a] = m.start[a][l];
    p.position[a] = m.position[a][l];
    p.before[a] = m.before[a][l];
    p.velocity[a] = m.velocity[a][l];
  }
  return p;
}

/// Work of the forces of pairs: their impulses times the mean velocity of the step.
template <class Geometry>
void add_pair_work(const ClusterForces<Geometry>& by, double kick_time, const MovingCluster<Geometry>& m,
                   Work& work) {
  Lane stress{}, viscosity{};
  for (int a = 0; a < Geometry::dimension; ++a) {
    const Lane impulse = m.mass * 0.5 * (m.before[a] + m.velocity[a]) * kick_time;
    stress += impulse * by.stress[a];
    viscosity += impulse * by.viscous[a];
  }
  work.stress += sum(stress);
  work.viscosity += sum(viscosity);
}

template <class Geometry> double largest_square_displacement(const MovingCluster<Geometry>& m) {
  Lane square{};
  for (int a = 0; a < Geometry::dimension; ++a) {
    const Lane way = m.position[a] - m.start[a];
    square += way * way;
  }
  return largest(square);
}

} // namespace

void Motion::add(const Motion& other) {
  work.add(other.work);
  square = std::max(square, other.square);
}

template <class Geometry> MovingCluster<Geometry> cluster_at_start(const Particles<Geometry>& p, int c) {
  MovingCluster<Geometry> m;
  m.first = c * lanes;
  m.used = std::min(lanes, p.count - m.first);
  m.mass = load(&p.mass[m.first]);
  for (int l = m.used; l < lanes; ++l) m.mass[l] = 0;
  for (int a = 0; a < Geometry::dimension; ++a) {
    m.position[a] = m.start[a] = load(&p.position[a][m.first]);
    m.velocity[a] = m.before[a] = load(&p.velocity[a][m.first]);
  }
  return m;
}

template <class Geometry>
void kick(const ClusterForces<Geometry>& by, double gravity, double kick_time, MovingCluster<Geometry>& m) {
  constexpr int D = Geometry::dimension;
  for (int a = 0; a < D; ++a)
    m.velocity[a] += kick_time * (by.stress[a] + by.viscous[a] - (a == D - 1 ? gravity : 0.0));
}

template <class Geometry>
void push_cluster(const MotionTerms<Geometry>& terms, const ClusterForces<Geometry>& by,
                  const Particles<Geometry>& particles, MovingCluster<Geometry>& m, Work& work,
                  std::span<WallLoad> loads, PushBuffer<Geometry::dimension>& buffer) {
  constexpr int D = Geometry::dimension;
  const double kick_time = terms.times.kick();
  for (int l = 0; l < m.used; ++l) {
    auto p = particle_of(m, l, work, loads);
    Vector<D> push;
    for (int a = 0; a < D; ++a) push[a] = kick_time * by.wall[a][l];
    push_by_walls(terms.pairs, terms.walls, m.first + l, particles.density[m.first + l], push, kick_time, p,
                  buffer);
    for (int a = 0; a < D; ++a) m.velocity[a][l] = p.velocity[a];
  }
}

template <class Geometry> void drift(double dt, MovingCluster<Geometry>& m) {
  for (int a = 0; a < Geometry::dimension; ++a) m.position[a] += dt * m.velocity[a];
}

template <class Geometry>
void touch_cluster(const WallsOfStep<Geometry::dimension>& walls, MovingCluster<Geometry>& m, Work& work,
                   std::span<WallLoad> loads) {
  for (int l = 0; l < m.used; ++l) {
    auto p = particle_of(m, l, work, loads);
    keep_off_walls(walls, p);
    for (int a = 0; a < Geometry::dimension; ++a) {
      m.position[a][l] = p.position[a];
      m.velocity[a][l] = p.velocity[a];
    }
  }
}

template <class Geometry>
void move_cluster(const MotionTerms<Geometry>& terms, const ClusterForces<Geometry>& by, int c,
                  Particles<Geometry>& p, Motion& motion, std::span<WallLoad> loads,
                  PushBuffer<Geometry::dimension>& buffer) {
  const Nearness nearness = terms.pairs.images.nearness[c];
  const double kick_time = terms.times.kick();
  auto m = cluster_at_start(p, c);
  kick(by, terms.walls.gravity, kick_time, m);
  if (nearness == Nearness::wall) push_cluster(terms, by, p, m, motion.work, loads, buffer);
  add_pair_work(by, kick_time, m, motion.work);
  drift(terms.times.dt, m);
  if (nearness != Nearness::none) touch_cluster(terms.walls, m, motion.work, loads);
  motion.square = std::max(motion.square, largest_square_displacement(m));
  for (int a = 0; a < Geometry::dimension; ++a) {
    store(&p.position[a][m.first], m.position[a], m.used);
    store(&p.velocity[a][m.first], m.velocity[a], m.used);
  }
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

template decltype(move_cluster<PlaneStrain>) move_cluster<PlaneStrain>;
template decltype(move_cluster<Axisymmetric>) move_cluster<Axisymmetric>;
template decltype(move_cluster<ThreeDimensional>) move_cluster<ThreeDimensional>;
template decltype(kinetic_energy<PlaneStrain>) kinetic_energy<PlaneStrain>;
template decltype(kinetic_energy<Axisymmetric>) kinetic_energy<Axisymmetric>;
template decltype(kinetic_energy<ThreeDimensional>) kinetic_energy<ThreeDimensional>;
template decltype(potential_energy<PlaneStrain>) potential_energy<PlaneStrain>;
template decltype(potential_energy<Axisymmetric>) potential_energy<Axisymmetric>;
template decltype(potential_energy<ThreeDimensional>) potential_energy<ThreeDimensional>;

} // namespace host
