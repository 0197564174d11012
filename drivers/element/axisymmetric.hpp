// SPDX-License-Identifier: BSD-3-Clause
// Laboratory tests on axisymmetric specimens that axial strain drives: the presets whose conditions leave one between
// axial and radial components. Compression positive, Pa.
#pragma once
#include "drivers/element/presets.hpp"

namespace drivers {

/// Stress or strain with component 11 along the axis, 22 = 33 radial, and no shear.
struct AxisymmetricTensor {
  double axial = 0, radial = 0;
  double trace() const { return axial + 2 * radial; }
};

/// Weights of a linear condition on stress and strain; those of the radial components count 22 and 33 together.
struct AxisymmetricCondition {
  AxisymmetricTensor stress, strain;
  /// The left-hand side.
  double at(const AxisymmetricTensor& sigma, const AxisymmetricTensor& epsilon) const {
    return stress.axial * sigma.axial + stress.radial * sigma.radial + strain.axial * epsilon.axial +
           strain.radial * epsilon.radial;
  }
};

struct AxisymmetricTest {
  std::string_view name; ///< of the preset
  AxisymmetricCondition held;

  /// Whether the condition is on strain alone, which fixes the ratio of the strain increments.
  bool prescribes_strain() const { return held.stress.axial == 0 && held.stress.radial == 0; }
  /// Radial over axial strain increment: the prescribed one, or that of an elastic material of Poisson's ratio 0.25.
  double strain_ratio() const;
  /// Whether the test keeps this linear quantity (condition.hpp) as it was at the start.
  bool holds(std::string_view quantity) const;
};

/// In the order of the presets.
const std::vector<AxisymmetricTest>& axisymmetric_tests();

/// The one of this name; null if there is none.
const AxisymmetricTest* find_axisymmetric_test(std::string_view name);

} // namespace drivers
