// SPDX-License-Identifier: BSD-3-Clause
// The straight pieces of a stage: a whole stage, half a cycle, the way between two rows of a replay.
#pragma once
#include "drivers/element/stage_run.hpp"

namespace drivers {

/// A piece of a stage, from fraction 0 to 1 of its control.
struct Leg {
  MixedControl control;
  long increments;
  double duration;           ///< s
  std::vector<Bound> limits; ///< that end the leg
  std::string place;         ///< for messages: the leg within the stage
};

enum class LegEnd { completed, limit, stop };

/// Takes a row through the legs of one stage.
class LegRun {
public:
  LegRun(const StageSetting& setting, const Stage& stage, ElementRow& row);

  /// Runs a leg, from the elastic stiffness of the data check if `fresh`. The row at its end is left to the
  /// caller to write. Throws if an increment cannot be completed.
  LegEnd run(const Leg& leg, bool fresh = false);
  /// Gives the row to the sink, unless it was given already.
  void write();
  /// Ends the test with a message that names stage, step and leg.
  [[noreturn]] void fail(const Leg& leg, const std::string& why) const;

  const Stage& stage;
  ElementRow& row;
  const ElementRow start;     ///< of the stage
  const MixedControl control; ///< at the start of the stage
  double reversal = 0;        ///< strain at the last one

private:
  /// The start of an increment: fraction of the leg, state, first guess of the stiffness.
  struct Increment {
    double from = 0;
    ElementRow before;
    Matrix6 tangent;
  };
  /// Takes `at` from one fraction of a leg to another and brings what follows from the point up to date.
  StepReport advanced(const Leg& leg, double from, double to, ElementRow& at, Matrix6& tangent) const;
  /// Shortens the increment that ends at `row` and `to` so that it ends on a bound it passed.
  void land_on(const Bound& bound, const Leg& leg, const Increment& increment, double& to);
  bool passed(const std::vector<Bound>& bounds) const;
  bool critical_since(const ElementRow& before) const;

  const StageSetting& setting;
  Matrix6 stiffness;
  const StageScale scale;
  const std::vector<Bound> stops;
  long last_written = -1; ///< step of the last row
};

} // namespace drivers
