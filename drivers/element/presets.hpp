// SPDX-License-Identifier: BSD-3-Clause
// Laboratory tests as a table: what may drive them and what they hold. Manual: ELEMENT.md.
#pragma once
#include "drivers/element/condition.hpp"

namespace drivers {

/// The conditions that a test holds besides the one that drives it, and the total stress that it holds if it is
/// undrained. Shear strains 23 and 31 are held, and 12 where it is not driven.
struct Preset {
  std::string name;
  std::vector<std::string> drives; ///< names of linear quantities; the first is the usual one
  std::vector<Condition> held;     ///< on the direct components and 12
  Vector6 held_total = Vector6::Zero();
  bool shears = false; ///< 12 is driven
  /// Key of a condition that is added when a stage is read: "intermediate_ratio", "stress_ratios" or
  /// "strain_ratios"; empty: none.
  std::string ratio{};
};

const std::vector<Preset>& presets();

/// The preset of this name; null if there is none.
const Preset* find_preset(std::string_view name);

} // namespace drivers
