// SPDX-License-Identifier: BSD-3-Clause
// The loading path of an element test: an initial state and stages. A stage is six linear conditions on stress and
// strain, of which the first changes once, to and fro (cyclic) or along a measured path (replay); or a probe of all
// directions (envelope). Vocabulary: condition.hpp, presets.hpp. Manual: ELEMENT.md.
// Compression positive, Pa, tensor shear strain; axis 1 is the axis of the specimen.
#pragma once
#include "drivers/element/condition.hpp"
#include "drivers/element/cyclic.hpp"
#include "drivers/element/driven_motion.hpp"
#include "drivers/element/envelope.hpp"
#include "drivers/element/material_point.hpp"
#include "drivers/element/measured_path.hpp"
#include "drivers/files/toml_table.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace drivers {

/// Ends a stage early: where a quantity passes a bound, or at the critical state.
struct StopRule {
  std::string quantity; ///< a column of the output, or a linear quantity
  bool above = false;
  double bound = 0;
  double critical_tolerance = 0; ///< above 0: the rule is the critical state, the others are unused
  bool met(double value) const { return above ? value > bound : value < bound; }
};

struct Stage {
  std::string name, control;
  std::array<Condition, 6> conditions; ///< the first, or those of a replay, are driven
  /// Weights of the total stress that the apparatus holds while the drain is closed; zero: drained.
  Vector6 held_total = Vector6::Zero();
  std::optional<double> pore_pressure; ///< Pa, of a drained stage; none: as at the end of the stage before
  long increments = 1;
  /// Increments between two rows; ends, reversals and rows of a replay are written in any case.
  long output_every = 1;
  double duration = 1; ///< s; of one increment in a cyclic stage
  std::vector<StopRule> stops;
  std::optional<Cycling> cycling;
  std::optional<MeasuredPath> measured;
  std::optional<Envelope> envelope;   ///< the conditions are unused
  std::optional<DrivenMotion> motion; ///< in place of the conditions
  std::string where;                  ///< FILE:LINE
};

struct InitialState {
  Vector6 stress = Vector6::Zero(); ///< effective, Pa
  double pore_pressure = 0;         ///< Pa
  std::vector<double> state;        ///< STATEV; empty: the material's own
};

/// Reads `[initial]` except its `void_ratio`.
InitialState read_initial_state(const TomlTable& table);

/// Reads one `[[stage]]`. `quantities` are the columns a stop rule may name beside linear quantities.
Stage read_stage(const TomlTable& table, int number, const Words& quantities);

/// How many of the last stages are run again, and how often.
struct Repetition {
  long stages, times;
};
/// Reads `[[stage]]` with the control "repeat" after `before` stages. None for another control.
std::optional<Repetition> read_repetition(const TomlTable& table, std::size_t before);

/// The conditions of a stage that starts at this stress and strain.
MixedControl control_from(const Stage& stage, const Vector6& stress, const Vector6& strain);

/// Change of pore pressure that keeps the held total stress while effective stress changes, Pa.
double pore_pressure_change(const Stage& stage, const Vector6& effective_change);

/// Change of pore pressure over the effective part of the held total stress at the start; 0 if drained.
double pore_pressure_ratio(const Stage& stage, const Vector6& start, double change);

/// What `control` may be: the presets, then the general ones.
Words control_names();

} // namespace drivers
