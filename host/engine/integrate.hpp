// SPDX-License-Identifier: BSD-3-Clause
// Kick, drift and contact of a cluster of particles, and the work done by each kind of force, so that the energy of a
// run can be closed.
#pragma once
#include "host/engine/momentum.hpp"
#include "host/walls/push.hpp"

namespace host {

/// Velocities live at half steps, so that free fall is exact for any sequence of steps: v += a (dt_before + dt)/2,
/// x += v dt. In the first step dt_before is 0.
struct StepTimes {
  double dt_before = 0, dt = 0; ///< s
  double kick() const { return 0.5 * (dt_before + dt); }
};

/// What moved in a step: work on particles, and the square of the largest displacement, m2.
struct Motion {
  Work work;
  double square = 0;
  void add(const Motion& other);
};

/// All of a step that the particles of a cluster need to move.
template <class Geometry> struct MotionTerms {
  PairsOfStep<Geometry> pairs;
  WallsOfStep<Geometry::dimension> walls;
  StepTimes times;
};

/// The eight particles of a cluster on their way through a step.
template <class Geometry> struct MovingCluster {
  static constexpr int D = Geometry::dimension;
  int first, used; ///< number of the first particle, and how many are particles, not padding
  Lane mass;       ///< kg, 0 of padding
  std::array<Lane, D> start, before; ///< m, m/s, at the start of the step
  std::array<Lane, D> position, velocity;
};

/// The particles of cluster c, before the step.
template <class Geometry>
MovingCluster<Geometry> cluster_at_start(const Particles<Geometry>& particles, int c);

/// Changes velocities by pairs and gravity.
template <class Geometry>
void kick(const ClusterForces<Geometry>& by, double gravity, double kick_time,
          MovingCluster<Geometry>& cluster);

/// Changes velocities by the images of walls and by friction, of the particles near walls; adds work and loads.
template <class Geometry>
void push_cluster(const MotionTerms<Geometry>& terms, const ClusterForces<Geometry>& by,
                  const Particles<Geometry>& particles, MovingCluster<Geometry>& cluster, Work& work,
                  std::span<WallLoad> loads, PushBuffer<Geometry::dimension>& buffer);

/// Moves particles by their velocities.
template <class Geometry> void drift(double dt, MovingCluster<Geometry>& cluster);

/// Keeps particles off walls and on their side of planes of symmetry; adds work and loads.
template <class Geometry>
void touch_cluster(const WallsOfStep<Geometry::dimension>& walls, MovingCluster<Geometry>& cluster,
                   Work& work, std::span<WallLoad> loads);

/// All of these for cluster c under the forces `by`, one after the other. Clusters that are out of reach of all
/// surfaces skip what concerns walls: their lists hold no images.
template <class Geometry>
void move_cluster(const MotionTerms<Geometry>& terms, const ClusterForces<Geometry>& by, int c,
                  Particles<Geometry>& particles, Motion& motion, std::span<WallLoad> loads,
                  PushBuffer<Geometry::dimension>& buffer);

/// Kinetic energy and potential energy above height 0, J (plane strain: J/m).
template <class Geometry> double kinetic_energy(const Particles<Geometry>& particles);
template <class Geometry> double potential_energy(const Particles<Geometry>& particles, double gravity);

} // namespace host
