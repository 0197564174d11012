// SPDX-License-Identifier: BSD-3-Clause
// Tables of numbers from text: a line of column names, then rows. Separators are commas, semicolons, tabs or
// blanks; lines that begin with # and empty ones are skipped; names may stand in quotes. Every error is one
// line, `FILE:LINE: ...`, thrown as std::runtime_error.
#pragma once
#include <string>
#include <vector>

namespace drivers {

class CsvTable {
public:
  /// Reads names and splits rows; a row with more or fewer cells than names is an error.
  explicit CsvTable(const std::string& file_name);

  /// Position of a column; an error that lists the names if there is none, or two.
  std::size_t column(const std::string& name) const;
  /// The number in a cell; an error that names line and column if it is none, or not finite.
  double number(std::size_t row, std::size_t column) const;

  std::size_t rows() const { return cells.size(); }
  int line(std::size_t row) const { return lines[row]; } ///< in the file, from 1
  const std::string& file() const { return name; }

private:
  std::string name;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells;
  std::vector<int> lines;
};

} // namespace drivers
