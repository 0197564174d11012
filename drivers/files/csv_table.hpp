// SPDX-License-Identifier: BSD-3-Clause
// Tables of numbers from files as laboratories, loggers and spreadsheets write them: text with any of four separators,
// decimal point or comma, any encoding, or a sheet of an .xlsx workbook. The stages: bytes -> text (decoded_text,
// workbook) -> records and cells (table_records) -> which lines are the table (table_rows, table_trial, table_layout)
// -> names and units (table_headings). Empty lines are skipped, and lines that begin with #, which are comments; those
// of the form `# name: value` are notes. Every error is one line, `FILE:LINE: ...`, thrown as std::runtime_error.
#pragma once
#include "drivers/files/table_layout.hpp"
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace drivers {

class CsvTable {
public:
  /// Reads a file. Errors: no table, a table that can be read in two ways, a row that does not fit.
  explicit CsvTable(const std::string& file_name, const TableFormat& format = {});

  bool has(std::string_view column) const;
  /// Position of a column by its heading as written, or by its name without the unit. An error that lists the names if
  /// there is none, or more than one.
  std::size_t column(std::string_view name) const;
  /// Position of a column by its number in the file, from 1; an error if there is none.
  std::size_t column(long number) const;
  const Heading& heading(std::size_t column) const { return layout.headings[column]; }
  std::size_t columns() const { return layout.headings.size(); }
  /// The number in a cell; an error that names line and column if it is none, or not finite.
  double number(std::size_t row, std::size_t column) const;
  /// What a cell holds; may be empty.
  const std::string& text(std::size_t row, std::size_t column) const {
    return layout.rows[row].cells[column];
  }
  /// All numbers of a column.
  std::vector<double> numbers(std::size_t column) const;
  std::vector<double> numbers(std::string_view name) const { return numbers(column(name)); }
  /// A note that is a number; an error without it.
  double note(std::string_view name) const;

  /// Drops rows with a gap in one of these columns if the format says missing = "skip".
  void drop_gaps(const std::vector<std::size_t>& columns);

  std::size_t rows() const { return layout.rows.size(); }
  int line(std::size_t row) const { return layout.rows[row].line; } ///< in the file, from 1
  const std::string& file() const { return name; }
  std::string column_names() const;
  /// What was understood, for the user: rows, separator, lines that were dropped, columns with their units.
  std::string summary() const;

private:
  void read_notes(const std::vector<Record>& records);

  std::string name, encoding;
  TableFormat format;
  TableLayout layout;
  std::vector<int> lines_with_gaps; ///< of rows that were dropped
  std::map<std::string, std::string, std::less<>> notes;
};

} // namespace drivers
