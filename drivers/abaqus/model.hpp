// SPDX-License-Identifier: BSD-3-Clause
// A scene as ABAQUS/Explicit needs it: particles in three dimensions, rigid parts of facets, the box that
// holds all motion. Axis z upwards from the floor. Axisymmetric scenes are full cylinders and plane strain
// scenes slabs on both sides of x = 0: particle elements see no images across a plane of symmetry.
#pragma once
#include "host/scene.hpp"
#include <array>

namespace drivers {

using Point3 = std::array<double, 3>;

/// Particles of one height, numbered without gaps.
struct AbaqusLayer {
  double height = 0;                   ///< m
  std::size_t first = 0, last = 0;     ///< positions in AbaqusModel::particles
  double horizontal = 0, vertical = 0; ///< initial normal stress, Pa, tension positive
  std::vector<double> state;           ///< initial STATEV
};

/// A rigid body of four-node facets, corners counterclockwise as the sand sees them.
struct AbaqusPart {
  std::string name;
  std::vector<Point3> nodes;
  std::vector<std::array<std::size_t, 4>> facets; ///< positions in `nodes`
  Point3 reference{};
};

struct AbaqusModel {
  std::vector<Point3> particles; ///< layer by layer, upwards
  std::vector<AbaqusLayer> layers;
  double pitch = 0;  ///< m, horizontal distance of particles
  double rise = 0;   ///< m, distance of layers
  double volume = 0; ///< m3, of the sand: particles x edge^3
  double edge = 0;   ///< m, of the cube that stands for one particle
  double depth = 0;  ///< m, of the slab along y; 0: a cylinder
  AbaqusPart floor;
  AbaqusPart wall;  ///< that retains the column; without facets where the scene removes it
  AbaqusPart sides; ///< of the slab; without facets for a cylinder
  Point3 box_lower{}, box_upper{};
};

/// Particles along y in a plane strain slab.
inline constexpr int slab_particles = 6;

/// How many particles a model of this spacing has, without building it.
double abaqus_particle_count(const host::Scene& scene, double spacing);

/// Throws std::runtime_error if the column holds no particle of `spacing`, or if the material refuses the
/// initial stress.
AbaqusModel make_abaqus_model(const host::Scene& scene, double spacing);

} // namespace drivers
