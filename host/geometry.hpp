// SPDX-License-Identifier: BSD-3-Clause
// What differs between geometries, as a template parameter of the stages: the dimension of the pair
// loops, the components of stress, the volume behind an area, the hoop terms. The last coordinate is
// vertical, upwards.
#pragma once
#include <numbers>

namespace host {

/// Position in the component order of the VUMAT (11, 22, 33, 12, ...) of the in-plane component a, b.
template <int Dimension> constexpr int component(int a, int b) {
  if (a == b) return a;
  return Dimension == 2 ? 3 : (a + b == 1 ? 3 : (a + b == 3 ? 4 : 5));
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
};

} // namespace host
