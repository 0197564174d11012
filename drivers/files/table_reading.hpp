// SPDX-License-Identifier: BSD-3-Clause
// What the stages of one trial to read a table share.
#pragma once
#include "drivers/files/table_layout.hpp"
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {

/// What one trial reads and makes.
struct Reading {
  const std::vector<Record>& records;
  const TableFormat& format;
  const std::string& file;
  std::vector<TableRow> rows;
  std::vector<RowBlock> blocks;
  RowBlock block; ///< the table
  TableLayout out;

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", file, line, what));
  }
  /// The record that begins at this line of the file.
  std::string_view text_of(int line) const {
    for (const auto& record : records)
      if (record.line == line) return record.text;
    fail(line, "expected a line of names or units, found nothing");
  }
  const TableRow& first_row() const { return rows[block.begin]; }
  bool starts_at_line() const {
    return format.first_line || format.units_line || format.names_line.value_or(0) > 0;
  }
};

/// Reads names and units of the columns into `reading.out`, from the lines that the user gives, else from those directly
/// above the table: a line of names, and one of units below or above it; two comments where no other line is above. An
/// error if the line above the table does not give a name to each column, or may be a row of numbers.
void read_names(Reading& reading);

} // namespace drivers
