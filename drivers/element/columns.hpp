// SPDX-License-Identifier: BSD-3-Clause
// The columns of an element test's output: name, unit and value of each. Their order is that of ELEMENT.md.
#pragma once
#include "drivers/element/critical_state.hpp"
#include "drivers/element/material_point.hpp"
#include <functional>

namespace drivers {

/// One row of output: the state after `step` increments of a stage, both counted from 1 (0: initial).
struct ElementRow {
  int stage = 0;
  long step = 0;
  PointState point;
  double pore_pressure = 0;       ///< Pa
  StepReport effort;              ///< of the increments since the row before
  double pore_pressure_ratio = 0; ///< of the stage; 0 if drained
  double cycles = 0;              ///< completed in a cyclic stage, in halves
  double double_amplitude = 0;    ///< strain since the last reversal of a cyclic stage
};

/// A column of the output. Its header is name_unit; `unit` is empty where there is none.
struct OutputColumn {
  std::string name, unit;
  std::function<double(const ElementRow&)> value;
  std::string header() const { return name + (unit.empty() ? "" : '_' + unit); }
};

/// All columns after stage and step. Void ratio, critical state and state variables are those the material has.
std::vector<OutputColumn> output_columns(const LoadedMaterial& material,
                                         const std::optional<CriticalState>& critical = {});

/// Void ratio after the strain alone: d e = -(1 + e) d eps_v.
double void_ratio_after(double initial, const Vector6& strain);

} // namespace drivers
