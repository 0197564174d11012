// SPDX-License-Identifier: BSD-3-Clause
// Where a stage, or a leg of its cycles, ends before its increments do.
#pragma once
#include "drivers/element/columns.hpp"
#include "drivers/element/load_path.hpp"

namespace drivers {

/// A bound on a number that changes along the path.
struct Bound {
  std::function<double(const ElementRow&)> value;
  bool above = true;
  double bound = 0;
  /// How far beyond; the bound is met above 0.
  double excess(const ElementRow& row) const { return above ? value(row) - bound : bound - value(row); }
};

/// The bounds of stop rules, in terms of columns or linear quantities; the critical state is none of them.
std::vector<Bound> bounds_of(const std::vector<StopRule>& stops, const std::vector<OutputColumn>& columns);

/// The limits of one direction of a cyclic stage that started at `start`.
std::vector<Bound> bounds_of(const Cycling& cycling, bool upwards, const ElementRow& start);

/// Critical state: over the increment from `before` to `now` the volume changed by less than the tolerance
/// times the deviatoric strain, q / p is within it (relative) of M at the Lode angle, and e of e_c.
bool is_critical(const CriticalState& critical, double initial_void_ratio, double tolerance,
                 const ElementRow& before, const ElementRow& now);

} // namespace drivers
