// SPDX-License-Identifier: BSD-3-Clause
// Tables of numbers from text: a line of column names, then rows. Separators are tabs, semicolons, commas or blanks,
// the first of these that the line of names holds; names may stand in quotes. Empty lines are skipped, and lines that
// begin with #, which are comments; those of the form `# name: value` are notes. Every error is one line,
// `FILE:LINE: ...`, thrown as std::runtime_error. (The CSV libraries Debian packages fix the number of columns at
// compile time, or keep no line numbers.)
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace drivers {

class CsvTable {
public:
  /// Reads names and splits rows. Errors: two columns of one name, a row with more or fewer cells than names, no row.
  explicit CsvTable(const std::string& file_name);

  bool has(std::string_view column) const;
  /// Position of a column; an error that lists the names if there is none.
  std::size_t column(std::string_view name) const;
  /// The number in a cell; an error that names line and column if it is none, or not finite.
  double number(std::size_t row, std::size_t column) const;
  /// What a cell holds; may be empty.
  const std::string& text(std::size_t row, std::size_t column) const { return cells[row][column]; }
  /// All numbers of a column.
  std::vector<double> numbers(std::string_view column) const;
  /// A note that is a number; an error without it.
  double note(std::string_view name) const;

  std::size_t rows() const { return cells.size(); }
  int line(std::size_t row) const { return lines[row]; } ///< in the file, from 1
  const std::string& file() const { return name; }
  std::string column_names() const;

private:
  /// Makes `line` a comment, a note, the line of names or a row.
  void take(const std::string& line, int number);

  std::string name;
  char separator = ',';
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells; ///< row by row
  std::vector<int> lines;
  std::map<std::string, std::string, std::less<>> notes;
};

} // namespace drivers
