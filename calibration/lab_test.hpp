// SPDX-License-Identifier: BSD-3-Clause
// Laboratory tests on axisymmetric specimens, as the fit has them: loading and measured curves. Compression positive, SI
// units, logarithmic strain, effective stress, q = sigma_axial - sigma_radial with its sign.
#pragma once
#include "drivers/element/axisymmetric.hpp"
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace calibration {

/// What a curve shows over axial strain.
enum class Measure {
  deviatoric_stress,
  axial_stress,
  radial_stress,
  mean_stress,
  stress_ratio, ///< q / p
  volumetric_strain,
  void_ratio,
  pore_pressure ///< its change since the start
};
struct MeasureInfo {
  std::string_view key, unit;
};
inline constexpr std::array<MeasureInfo, 8> measures{{
    {"deviatoric_stress", "Pa"},
    {"axial_stress", "Pa"},
    {"radial_stress", "Pa"},
    {"mean_stress", "Pa"},
    {"stress_ratio", "-"},
    {"volumetric_strain", "-"},
    {"void_ratio", "-"},
    {"pore_pressure", "Pa"},
}};
inline const MeasureInfo& info(Measure m) {
  return measures[std::size_t(m)];
}

/// A specimen and its loading: axial strain up to `end_strain` (negative: extension).
struct Specimen {
  const drivers::AxisymmetricTest* kind = nullptr;
  double void_ratio = 0;                      ///< initial
  double axial_stress = 0, radial_stress = 0; ///< initial, Pa
  double end_strain = 0;

  double mean_stress() const { return (axial_stress + 2 * radial_stress) / 3; } ///< initial, Pa
};

/// One measured curve: a value for each strain of its test.
struct Curve {
  Measure measure;
  std::vector<double> values;
};

struct LabTest {
  std::string name;
  Specimen specimen;
  std::vector<double> strain; ///< axial, monotonic from 0
  std::vector<Curve> curves;  ///< compared with the model
  double weight = 1;          ///< of its log likelihood
  bool held_out = false;      ///< predicted, not fitted
};

} // namespace calibration
