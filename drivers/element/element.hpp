// SPDX-License-Identifier: BSD-3-Clause
// The single-element driver: reads a path file, takes one material point along its stages, writes one
// CSV row per increment. Manual: ELEMENT.md.
#pragma once
#include "drivers/element/load_path.hpp"
#include "drivers/element/material_point.hpp"
#include "drivers/element/stage_run.hpp"
#include "drivers/files/material_file.hpp"
#include <functional>
#include <string>
#include <vector>

namespace drivers {

/// A path file, read.
struct ElementCase {
  std::string title;
  LoadedMaterial material;
  std::optional<CriticalState> critical;
  PointState initial;
  double pore_pressure = 0; ///< Pa, initial
  std::vector<Stage> stages;
  NewtonOptions newton;
  std::string resolved; ///< the path file with every key written out
};

/// Throws std::runtime_error with FILE:LINE.
ElementCase read_element_case(const TomlTable& document);

/// Runs all stages and returns the last row. `sink` receives the rows that are to be written, `envelopes` the probes of
/// envelope stages. If an increment cannot be completed, the row of the last one that could goes to `sink`, and
/// std::runtime_error names stage, step, residual and its unit. If the material failed, the error names fault, stress
/// and strain increment, and the call goes to the file `failed_point`, unless that is empty.
ElementRow run_element_case(
    const ElementCase& element, const RowSink& sink,
    const EnvelopeSink& envelopes = [](const EnvelopeRow&) {}, const std::string& failed_point = {});

} // namespace drivers
