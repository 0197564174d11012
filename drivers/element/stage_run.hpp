// SPDX-License-Identifier: BSD-3-Clause
// One stage of an element test: its increments, straight, to and fro, or along a measured path.
#pragma once
#include "drivers/element/bounds.hpp"

namespace drivers {

/// Called for rows that are to be written.
using RowSink = std::function<void(const ElementRow&)>;

/// What the stages of a test share.
struct StageSetting {
  MaterialCaller& material;
  const std::vector<OutputColumn>& columns;
  const std::optional<CriticalState>& critical;
  std::optional<double> initial_void_ratio;
  const NewtonOptions& newton;
  const RowSink& sink;
  const std::string& failed_point; ///< file that receives a call that failed, to be repeated; empty: none
};

/// Takes `row` through the increments of a stage that is no envelope. If an increment cannot be completed, writes the
/// row of the last one and throws std::runtime_error naming stage, step, residual and its unit.
void run_stage(const StageSetting& setting, const Stage& stage, ElementRow& row);

} // namespace drivers
