// SPDX-License-Identifier: BSD-3-Clause
// The legs of a stage, in which conditions change linearly: a whole stage, half a cycle, the part between two rows of a
// measured path.
#pragma once
#include "drivers/element/stage_run.hpp"

namespace drivers {

/// A part of a stage, from fraction 0 to 1 of its control.
struct Leg {
  MixedControl control;
  long increments;
  double duration;           ///< s
  std::vector<Bound> limits; ///< that end the leg
  std::string place;         ///< names the leg in messages
};

enum class LegEnd { completed, limit, stop };

/// Takes a row through the legs of one stage.
class LegRun {
public:
  LegRun(const StageSetting& setting, const Stage& stage, ElementRow& row);

  /// Runs a leg; with `from_elastic` the first guess is the elastic stiffness. The caller writes the row at its end.
  /// Throws std::runtime_error if an increment cannot be completed.
  LegEnd run(const Leg& leg, bool from_elastic = false);
  /// Gives the row to the sink, once.
  void write();
  /// Ends the test with a message that names stage, step and leg.
  [[noreturn]] void fail(const Leg& leg, const std::string& why) const;

  const Stage& stage;
  ElementRow& row;
  const ElementRow start;     ///< of the stage
  const MixedControl control; ///< at the start of the stage
  double reversal_strain = 0; ///< at the last reversal of a cyclic stage

private:
  /// Where an increment starts: fraction of the leg, state, first guess of the stiffness.
  struct IncrementStart {
    double from = 0;
    ElementRow before;
    Matrix6 tangent;
  };
  /// Takes `at` from one fraction of a leg to another and updates its pore pressure and amplitude.
  StepReport advance_row(const Leg& leg, double from, double to, ElementRow& at, Matrix6& tangent) const;
  /// Shortens the increment that ends at `row` and `to` so that it ends on a bound that it passed.
  void end_on(const Bound& bound, const Leg& leg, const IncrementStart& start, double& to);
  bool passed(const std::vector<Bound>& bounds) const;
  bool critical_since(const ElementRow& before) const;

  const StageSetting& setting;
  Matrix6 stiffness;
  const StageScale scale;
  const std::vector<Bound> stops;
  long last_written = -1; ///< step of the last row
};

} // namespace drivers
