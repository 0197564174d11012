// SPDX-License-Identifier: BSD-3-Clause
// Kick and drift, with gravity, floor friction and the guards of the walls; and the work done by each
// kind of force, so that the energy of a run can be closed.
#pragma once
#include "host/engine/momentum.hpp"
#include "host/walls/mirrors.hpp"

namespace host {

/// Work done on the particles since the start, J (plane strain: J/m), by the forces of pairs and walls.
struct Work {
  double stress = 0;    ///< by the stress of pairs
  double viscosity = 0; ///< by artificial viscosity, never positive
  double wall = 0;      ///< by the images behind walls and by the guards
  double friction = 0;  ///< by Coulomb friction on the floor, never positive
  long guarded = 0;     ///< times a particle was held back at a wall or the axis

  double total() const { return stress + viscosity + wall + friction; }
  void add(const Work& other);
};

/// Distance, in spacings, at which a particle touches a wall: somewhat less than the half spacing at which
/// lattices start, so that a resting layer is carried by the images' stress alone.
inline constexpr double contact_gap = 0.4;
/// The same for the axis: a ring much narrower than half a spacing is stiff, and its section much larger than a particle.
inline constexpr double axis_gap = 0.4;

/// Work on particles in one step, what floor and gate took up, and the square of the largest displacement, m2.
struct ClusterMotion {
  Work work;
  std::array<WallLoad, 2> load{};
  double square = 0;
  void add(const ClusterMotion& other);
};

/// v += a (dt_before + dt)/2, x += v dt: velocities live at half steps (dt_before is 0 in the first one), so
/// free fall is exact for any sequence of steps. Coulomb friction opposes the tangential velocity of a particle on the floor by
/// at most `floor.friction` times what the floor pushes it up with. A particle that would come nearer to
/// a wall than the contact gap stays there, loses its speed towards it, and on the floor as much
/// tangential speed as friction takes for that impulse. Of cluster c, under the forces `by`.
template <class Geometry>
ClusterMotion move_cluster(Particles<Geometry>& particles, const Scene& scene,
                           const std::vector<Mirror>& mirrors, double reach, double dt_before, double dt,
                           const ClusterForces<Geometry>& by, int c);

/// Kinetic energy and potential energy above the floor, J (plane strain: J/m).
template <class Geometry> double kinetic_energy(const Particles<Geometry>& particles);
template <class Geometry> double potential_energy(const Particles<Geometry>& particles, double gravity);

} // namespace host
