// SPDX-License-Identifier: BSD-3-Clause
// What walls have done: the work of each kind of force on the sand, and the load of each wall.
#pragma once
#include "host/walls/wall.hpp"

namespace host {

/// Work done on the particles since the start, J (plane strain: J/m), by the forces of pairs and walls.
struct Work {
  double stress = 0;    ///< by the stress of pairs
  double viscosity = 0; ///< by artificial viscosity, never positive
  double wall = 0;      ///< by the images behind walls and by contact
  double friction = 0;  ///< by Coulomb friction at walls; never positive where these are at rest
  long guarded = 0;     ///< times a particle was stopped by contact with a wall or a plane of symmetry

  double total() const { return stress + viscosity + wall + friction; }
  void add(const Work& other) {
    stress += other.stress;
    viscosity += other.viscosity;
    wall += other.wall;
    friction += other.friction;
    guarded += other.guarded;
  }
};

} // namespace host
