// SPDX-License-Identifier: BSD-3-Clause
// Images and neighbour lists of a simulation, and when they are renewed.
#pragma once
#include "host/engine/simulation.hpp"

namespace host {

/// How far neighbour lists and images reach, m.
template <class Geometry> double list_reach(const Simulation<Geometry>& simulation);

/// Sorts the particles and finds images and neighbours anew.
template <class Geometry> void update_lists(Simulation<Geometry>& simulation);

/// Puts surfaces where they are now and writes the motion records of particles and images. Renews the lists if particles
/// and walls may have come nearer to each other by half of the skin, and prunes them if by half of the narrow one.
template <class Geometry> void update_neighbours(Simulation<Geometry>& simulation);

/// How far a wall may move along itself before the lists are renewed, m: if it is within reach of the sand by half of
/// the reach, else until it comes into reach.
template <class Geometry> double free_way(const Simulation<Geometry>& simulation, int wall);

/// True if a particle may have images in a surface of the wall.
template <class Geometry> bool in_reach(const Simulation<Geometry>& simulation, int wall);

} // namespace host
