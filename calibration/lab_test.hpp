// SPDX-License-Identifier: BSD-3-Clause
// Laboratory tests on axisymmetric specimens, in the terms of the fit: what is done, what is measured. Compression
// positive, SI, strains logarithmic, stress effective, q = sigma_axial - sigma_radial with its sign.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace calibration {

enum class TestKind { triaxial_drained, triaxial_undrained, triaxial_constant_p, oedometric };
inline constexpr std::array<std::string_view, 4> kind_names{"triaxial-drained", "triaxial-undrained",
                                                            "triaxial-constant-p", "oedometric"};

/// What a curve shows over the axial strain.
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

/// A specimen and what is done to it: axial strain up to `end_strain` (negative: extension).
struct Specimen {
  TestKind kind = TestKind::triaxial_drained;
  double void_ratio = 0;                      ///< initial
  double axial_stress = 0, radial_stress = 0; ///< initial, Pa
  double end_strain = 0;
};

/// Points of one measured curve, one for each strain of its test.
struct Curve {
  Measure measure;
  std::vector<double> values;
};

struct LabTest {
  std::string name;
  Specimen specimen;
  std::vector<double> strain; ///< axial, from 0 on without turning back
  std::vector<Curve> curves;  ///< compared with the model
  double weight = 1;          ///< of its log likelihood
  bool held_out = false;      ///< predicted, not fitted
};

} // namespace calibration
