// SPDX-License-Identifier: BSD-3-Clause
// The single-element driver: reads a path file, takes one material point along its stages, writes one
// CSV row per increment. Manual: ELEMENT.md.
#pragma once
#include "drivers/load_path.hpp"
#include "drivers/material_file.hpp"
#include "drivers/material_point.hpp"
#include <functional>
#include <string>
#include <vector>

namespace drivers {

/// A path file, read.
struct ElementCase {
  std::string title;
  LoadedMaterial material;
  PointState initial;
  double pore_pressure = 0; ///< Pa, initial
  std::vector<Stage> stages;
  NewtonOptions newton;
  std::string resolved; ///< the path file with every key written out
};

/// Throws std::runtime_error with FILE:LINE.
ElementCase read_element_case(const TomlTable& document);

/// One row of output: the state after `step` increments of a stage, both counted from 1 (0: initial).
struct ElementRow {
  int stage = 0;
  long step = 0;
  PointState point;
  double pore_pressure = 0; ///< Pa
  StepReport effort;
};

/// A column of the output. `unit` is part of its name in the header, "" for none.
struct Quantity {
  std::string name, unit;
  std::function<double(const ElementRow&)> value;
};
std::vector<Quantity> quantities(const LoadedMaterial& material);

/// Called for the initial state, for every `output_every`-th increment and for the last one of a stage.
using RowSink = std::function<void(const ElementRow&)>;

/// Runs all stages and returns the last row. Throws std::runtime_error naming stage, step, residual and its
/// unit if a step cannot be completed, after the row of the last one that could.
ElementRow run_element_case(const ElementCase& element, const RowSink& sink);

struct ElementOptions {
  std::string path_file;
  std::string output;   ///< CSV file; empty or "-": standard output
  std::string resolved; ///< file for the path with every key written out; empty: none
};

/// The command `simsand element`: 0, or 1 after one line on standard error.
int run_element(const ElementOptions& options);

} // namespace drivers
