// SPDX-License-Identifier: BSD-3-Clause
// What is done to an element: an initial state and stages, each six linear conditions on stress and
// strain. Presets of laboratory tests are rows of a table (load_path.cpp); ELEMENT.md is their manual.
// Compression positive, Pa, tensor shear strain; axis 1 is the axis of the specimen.
#pragma once
#include "drivers/material_point.hpp"
#include "drivers/toml_table.hpp"
#include <array>
#include <string>
#include <vector>

namespace drivers {

/// stress . sigma' + strain . epsilon changes by `value` over the stage, or ends at it.
struct Condition {
  Vector6 stress = Vector6::Zero(), strain = Vector6::Zero();
  double value = 0;
  bool is_final = false;
  const char* unit() const { return stress.isZero(0) ? "(strain)" : "Pa"; }
};

/// Ends a stage early, after the first increment at which a column of the output passes a bound.
struct StopRule {
  std::string quantity;
  bool above = false;
  double bound = 0;
  bool met(double value) const { return above ? value > bound : value < bound; }
};

struct Stage {
  std::string name, control;
  std::array<Condition, 6> conditions;
  /// Weights of the total stress that the apparatus holds while the drain is closed; zero: drained.
  Vector6 held_total = Vector6::Zero();
  long increments = 1;
  long output_every = 1; ///< increments between two rows; the last one is always written
  double duration = 1;   ///< s
  std::vector<StopRule> stops;
  std::string where; ///< FILE:LINE
};

struct InitialState {
  Vector6 stress = Vector6::Zero(); ///< effective, Pa
  double pore_pressure = 0;         ///< Pa
  std::vector<double> state;        ///< STATEV; empty: the material's own
};

/// Reads `[initial]` but its `void_ratio`.
InitialState read_initial_state(const TomlTable& table);

/// Reads one `[[stage]]`. `quantities` are the columns a stop rule may name.
Stage read_stage(const TomlTable& table, int number, const Words& quantities);

/// The conditions of a stage that starts at this stress and strain.
MixedControl control_from(const Stage& stage, const Vector6& stress, const Vector6& strain);

/// Change of pore pressure that keeps the held total stress while effective stress changes, Pa.
double pore_pressure_change(const Stage& stage, const Vector6& effective_change);

/// Names of the presets, in the order of the table.
Words control_names();

} // namespace drivers
