// SPDX-License-Identifier: BSD-3-Clause
// `simsand study columns`: the 24 columns of Jin, Lu and Yang, Table 2, in axisymmetry, beside discrete elements and the
// laboratory's laws. Runs that are complete are not run again. Manual and results: COLUMNS.md.
#pragma once
#include "drivers/study/parameter_sets.hpp"
#include "drivers/study/runs.hpp"

namespace drivers {

struct ColumnStudyOptions {
  StudyOptions study{"results/columns", ""};
  std::vector<double> spacings = {1e-3, 2e-3,
                                  4e-3}; ///< m; the tables show the finest, the others its error and cost
  std::vector<std::string> sets = parameter_sets();
  std::string only; ///< part of the names of the columns to run; empty: all
};

/// Columns of the data folder whose names have `only` in them, sorted. Throws std::runtime_error if there are none.
std::vector<StudyColumn> study_columns_of(const std::string& data, const std::string& only);

/// Runs what is missing, then writes the tables, the pictures and the page. Throws std::runtime_error
/// naming the runs that failed and their logs, after all others have ended.
void study_columns(const ColumnStudyOptions& options);

} // namespace drivers
