// SPDX-License-Identifier: BSD-3-Clause
// `simsand study columns`: the 24 columns of Jin, Lu and Yang, Table 2, in axisymmetry, beside discrete elements and the
// laboratory's laws. Runs that are complete are not run again. Manual and results: COLUMNS.md.
#pragma once
#include "drivers/study/runs.hpp"

namespace drivers {

struct ColumnStudyOptions {
  StudyOptions study{"results/columns", ""};
  double spacing = 1e-3;                      ///< m
  std::vector<std::string> sets = {"table4"}; ///< parameter sets: table4, dem, literal
  std::string only;                           ///< part of the names of the columns to run; empty: all
};

/// Runs what is missing, then writes the tables, the pictures and the page. Throws std::runtime_error naming the
/// runs that failed and their logs, after all others have ended.
void study_columns(const ColumnStudyOptions& options);

} // namespace drivers
