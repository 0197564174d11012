// SPDX-License-Identifier: BSD-3-Clause
// The parameter sets that a study of columns runs side by side.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace drivers {

/// One of the 24 columns.
struct StudyColumn {
  std::string name;      ///< of the scene, as ss_dense_a0.5
  std::string scene;     ///< file
  std::string data;      ///< the project's data folder
  double void_ratio = 0; ///< of the scene: Table 2, the printed number taken as porosity

  std::string shape() const;   ///< SS, TS or ES
  std::string packing() const; ///< dense or loose
  std::string aspect() const;  ///< as 0.5
};

/// All sets:
/// - table4          parameters of the paper's Table 4
/// - dem             parameters calibrated on triaxial tests by discrete elements of the same grains
/// - literal         Table 4, and the number that Table 2 prints as void ratio taken by its name
/// - dem_packing     as dem, with the void ratio that the column of discrete elements had when it was released
/// - drucker_prager  Drucker-Prager without dilation, at the critical friction angle of set dem
const std::vector<std::string>& parameter_sets();

/// Sets beside the first two: asked what a choice matters, not run at the finest spacings.
bool is_sensitivity(const std::string& set);

/// The settings that make the column's scene one of the set; nothing where the set does not have this column (no
/// discrete elements of it). Throws std::runtime_error naming the file that is missing.
std::optional<std::vector<std::string>> set_settings(const std::string& set, const StudyColumn& column);

/// Material file calibrated on discrete elements. Throws std::runtime_error if there is none.
std::string calibrated_material(const StudyColumn& column);

} // namespace drivers
