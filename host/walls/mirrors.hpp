// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that reflect: planes of symmetry, the floor, the retaining wall. A particle near one has an image
// behind it, so supports are complete there and the pair loops know no walls. A cylinder reflects in its
// tangent plane at the particle; its images stand on a longer circle and have the volume of their place.
#pragma once
#include "host/engine/records.hpp"
#include "host/scene.hpp"
#include <cmath>

namespace host {

/// The plane `coordinate[axis] = position` with the material on its positive side if `positive_side`; or
/// the cylinder of radius `position` about the vertical axis, with the material inside.
struct Mirror {
  static constexpr int radial = -1; ///< `axis` of a cylinder
  int axis = 0;
  double position = 0; ///< m
  bool positive_side = true;
  bool wall = false;           ///< its forces are wall forces; false: the material continues
  bool gate = false;           ///< the retaining wall
  bool no_slip = false;        ///< a plane at which velocities pass through zero: shear goes on across it
  double weight_gradient = 0;  ///< N/m3: vertical stress in the image grows downwards by it
  double horizontal_ratio = 0; ///< horizontal over vertical part of that growth
  double lower_edge = 0;       ///< m: acts on what lies above; changes in time
  bool cylinder() const { return axis == radial; }
};

/// Distance from the vertical axis, m. (A few times faster than std::hypot, which guards against overflow.)
template <class Point> inline double from_axis(const Point& x) {
  return std::sqrt(x[0] * x[0] + x[1] * x[1]);
}

/// Distance from the mirror, m, positive on the side of the material.
template <class Point> inline double depth_behind(const Mirror& m, const Point& x) {
  if (m.cylinder()) return m.position - from_axis(x);
  return m.positive_side ? x[m.axis] - m.position : m.position - x[m.axis];
}

/// Unit normal of the mirror towards the material, at a point off the axis of a cylinder.
template <int D> inline std::array<double, D> normal_at(const Mirror& m, const double (&x)[D]) {
  std::array<double, D> n{};
  if (m.cylinder()) {
    const double r = from_axis(x);
    n[0] = -x[0] / r;
    n[1] = -x[1] / r;
  } else
    n[m.axis] = m.positive_side ? 1 : -1;
  return n;
}

/// True for vertical mirrors, which end at their lower edge.
template <int D> constexpr bool ends_below(const Mirror& m) {
  return m.cylinder() || m.axis != D - 1;
}

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

/// The mirrors of a scene at its start, planes of symmetry first; only these where the scene has a list of walls.
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
