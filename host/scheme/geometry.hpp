// SPDX-License-Identifier: BSD-3-Clause
// What differs between geometries, as a template parameter: dimension, components of stress, the volume that belongs to
// an area, hoop terms. The last coordinate is vertical, upwards; in three dimensions it is z, so that the stress
// components are 11, 22 (horizontal), 33 (vertical), 12, 23, 31.
#pragma once
#include "host/scene.hpp"
#include <numbers>

namespace host {

/// Position in the component order of the VUMAT (11, 22, 33, 12, ...) of the in-plane component a, b.
template <int Dimension> constexpr int component(int a, int b) {
  if (a == b) return a;
  return Dimension == 2 ? 3 : (a + b == 1 ? 3 : (a + b == 3 ? 4 : 5));
}

/// Axes of component c of a symmetric tensor of the coordinates: D normal components, then 12, 23, 31.
template <int D> constexpr int first_axis(int c) {
  return c < D ? c : (c - D) % D;
}
template <int D> constexpr int second_axis(int c) {
  return c < D ? c : (c - D + 1) % D;
}

/// x horizontal, y vertical, unit thickness.
struct PlaneStrain {
  static constexpr const char* name = "plane_strain";
  static constexpr int dimension = 2;
  static constexpr int shear_components = 1;
  static constexpr int stress_components = 4;
  static constexpr bool hoop = false;
  /// Thickness in units of `depth` that a particle at horizontal coordinate x stands for.
  static double weight(double) { return 1; }
  static constexpr double depth = 1;
  /// The volume under an outline is depth_of_outline * integral of weight_of_outline * height.
  static double weight_of_outline(double) { return 1; }
  static constexpr double depth_of_outline = 1;
};

/// r horizontal, z vertical; a particle is a ring. Component 33 is the hoop direction.
struct Axisymmetric {
  static constexpr const char* name = "axisymmetric";
  static constexpr int dimension = 2;
  static constexpr int shear_components = 1;
  static constexpr int stress_components = 4;
  static constexpr bool hoop = true;
  static double weight(double r) { return r; }
  static constexpr double depth = 2 * std::numbers::pi;
  static double weight_of_outline(double r) { return r; }
  static constexpr double depth_of_outline = 2 * std::numbers::pi;
};

/// x and y horizontal, z vertical; all of space, or the sector on the positive side of one or two planes of symmetry.
struct ThreeDimensional {
  static constexpr const char* name = "three_dimensional";
  static constexpr int dimension = 3;
  static constexpr int shear_components = 3;
  static constexpr int stress_components = 6;
  static constexpr bool hoop = false;
  static double weight(double) { return 1; }
  static constexpr double depth = 1;
  static double weight_of_outline(double r) { return r; }
  static constexpr double depth_of_outline = 2 * std::numbers::pi;
};

/// Calls f(PlaneStrain{}), f(Axisymmetric{}) or f(ThreeDimensional{}) and returns its result.
template <class F> auto with_geometry(GeometryKind kind, F&& f) {
  if (kind == GeometryKind::plane_strain) return f(PlaneStrain{});
  if (kind == GeometryKind::axisymmetric) return f(Axisymmetric{});
  return f(ThreeDimensional{});
}

} // namespace host
