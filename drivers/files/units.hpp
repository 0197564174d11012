// SPDX-License-Identifier: BSD-3-Clause
// Units of measured columns, as laboratories write them.
#pragma once
#include <string>
#include <string_view>

namespace drivers {

enum class UnitKind { ratio, stress, length, area, volume, force, time };

struct Unit {
  std::string_view name;
  UnitKind kind;
  double size; ///< in 1, Pa, m, m2, m3, N, s
};

/// The unit of this name, without brackets; null if there is none.
const Unit* find_unit(std::string_view name);

/// Names of the units of one kind, for messages.
std::string unit_names(UnitKind kind);

/// What the unit measures: "a ratio or strain", "a stress" and so on, for messages.
std::string_view kind_name(UnitKind kind);

} // namespace drivers
