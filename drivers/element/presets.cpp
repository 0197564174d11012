// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/presets.hpp"
#include <algorithm>

namespace drivers {
namespace {

using Names = std::vector<std::string>;

Condition held_stress(const Vector6& w) {
  return {w, Vector6::Zero(), 0, false};
}
Condition held_strain(const Vector6& w) {
  return {Vector6::Zero(), w, 0, false};
}

std::vector<Preset> preset_table() {
  const Vector6 none = Vector6::Zero(), trace = weights(1, 1, 1), cell = weights(0, 1, 0),
                vertical = weights(1, 0, 0), side = weights(0, 0, 1);
  const auto s11 = held_stress(vertical), s22 = held_stress(cell), s33 = held_stress(side),
             p = held_stress(trace), s11_is_s22 = held_stress(weights(1, -1, 0)),
             s22_is_s33 = held_stress(weights(0, 1, -1));
  const auto e11 = held_strain(vertical), e22 = held_strain(cell), e33 = held_strain(side),
             volume = held_strain(trace);
  const Names confined{"axial_strain", "axial_stress"}, axial{"axial_strain", "axial_stress", "deviator"},
      radial{"radial_strain", "radial_stress", "deviator"}, shear{"shear_strain", "shear_stress"};
  const std::string b = "intermediate_ratio";
  return {
      {"isotropic", {"mean_stress", "volumetric_strain"}, {s11_is_s22, s22_is_s33}},
      {"oedometric", confined, {e22, e33}},
      {"triaxial-drained", axial, {s22, s33}},
      {"triaxial-undrained", axial, {volume, s22_is_s33}, cell},
      {"triaxial-constant-p", axial, {p, s22_is_s33}},
      {"triaxial-constant-volume", axial, {volume, s22_is_s33}},
      {"triaxial-lateral", radial, {s11, s22_is_s33}},
      {"plane-strain-drained", axial, {s22, e33}},
      {"plane-strain-undrained", axial, {volume, e33}, cell},
      {"plane-strain-constant-p", axial, {p, e33}},
      {"simple-shear-drained", shear, {s11, e22, e33}, none, true},
      {"simple-shear-undrained", shear, {e11, e22, e33}, vertical, true},
      {"torsional-shear-drained", shear, {s11, s22, s33}, none, true},
      {"torsional-shear-undrained", shear, {volume, s11_is_s22, s22_is_s33}, cell, true},
      {"true-triaxial-drained", axial, {s33}, none, false, b},
      {"true-triaxial-undrained", axial, {volume}, side, false, b},
      {"true-triaxial-constant-p", axial, {p}, none, false, b},
      {"proportional-stress", confined, {}, none, false, "stress_ratios"},
      {"proportional-strain", confined, {}, none, false, "strain_ratios"},
  };
}

} // namespace

const std::vector<Preset>& presets() {
  static const auto table = preset_table();
  return table;
}

const Preset* find_preset(std::string_view name) {
  const auto& all = presets();
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == name; });
  return at == all.end() ? nullptr : &*at;
}

} // namespace drivers
