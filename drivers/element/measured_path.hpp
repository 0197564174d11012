// SPDX-License-Identifier: BSD-3-Clause
// A measured path: columns of a table that drive the first conditions of a stage, row by row.
#pragma once
#include "drivers/element/condition.hpp"
#include "drivers/files/toml_table.hpp"

namespace drivers {

struct MeasuredRow {
  int line;                    ///< in the file
  std::vector<double> targets; ///< per driven column: strain since the start of the stage, or stress, Pa
  double time;                 ///< s
};

struct MeasuredPath {
  std::string file;
  std::vector<const LinearQuantity*> driven;
  std::vector<MeasuredRow> rows;
  bool timed = false;          ///< the table has a column of time, which grows from row to row
  long substeps = 1;           ///< smallest number of increments from row to row
  double strain_increment = 0; ///< largest change of a driven strain per increment; 0: any

  /// Increments from one row to the next.
  long increments(const std::vector<double>& from, const std::vector<double>& to) const;
};

/// Reads `[stage.replay]` and its file, which holds one row at least.
MeasuredPath read_measured_path(const TomlTable& table);

} // namespace drivers
