// SPDX-License-Identifier: BSD-3-Clause
// Planes that reflect: the axis of symmetry, the floor, the retaining wall. A particle near a plane
// has an image behind it, so supports are complete there and the pair loops know no walls.
#pragma once
#include "host/records.hpp"
#include "host/scene.hpp"

namespace host {

/// A plane `coordinate[axis] = position`; the material lies on its positive side if `positive_side`.
struct Mirror {
  int axis = 0;
  double position = 0; ///< m
  bool positive_side = true;
  bool wall = false;           ///< its forces are wall forces; false: the material continues
  double weight_gradient = 0;  ///< N/m3: vertical stress in the image grows downwards by it
  double horizontal_ratio = 0; ///< horizontal over vertical part of that growth
  double lower_edge = 0;       ///< m: acts on what lies above; changes in time
};

/// An image: of record `source` (a particle or an earlier image) in mirror `mirror`.
struct Image {
  int source, mirror;
};

/// The images of one arrangement of particles, and how to refresh their records.
struct Images {
  std::vector<Image> list;
  int first = 0;      ///< record index of the first image
  int first_wall = 0; ///< record index of the first image behind a wall
};

/// The planes of a scene at its start.
std::vector<Mirror> scene_mirrors(const Scene& scene);

/// Moves the retaining wall to where it is at `time`, s.
void move_gate(std::vector<Mirror>& mirrors, const Scene& scene, double time);

/// Lists images of all particles within `reach` of a mirror, interior ones first.
template <class Geometry>
Images find_images(const Particles<Geometry>& particles, const std::vector<Mirror>& mirrors, double reach);

/// Writes the images' records from their sources' (which must be up to date).
template <class Geometry>
void reflect_motion(const Images& images, const std::vector<Mirror>& mirrors, Records<Geometry>& records);
template <class Geometry>
void reflect_stress(const Images& images, const std::vector<Mirror>& mirrors, Records<Geometry>& records);

} // namespace host
