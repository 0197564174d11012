// SPDX-License-Identifier: BSD-3-Clause
// Tables of numbers with a header line. Lines that begin with '#' are comments; those of the form `# name: value` are
// notes. (The CSV libraries Debian packages fix the number of columns at compile time, or keep no line numbers.)
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace calibration {

class CsvTable {
public:
  /// Reads a whole file. Throws std::runtime_error naming file and line of a row with too few or too many cells.
  CsvTable(const std::string& file, char separator);

  bool has(std::string_view column) const;
  /// Numbers of one column. Throws, naming file, line and column, on a cell that is not a finite number.
  std::vector<double> numbers(std::string_view column) const;
  /// Line of a row in the file, from 1.
  long line(std::size_t row) const { return lines[row]; }
  std::size_t rows() const { return cells.size(); }
  std::string column_names() const;
  /// A note that is a number; throws, naming the file, without it.
  double note(std::string_view name) const;

  const std::string file;

private:
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> cells; ///< row by row
  std::vector<long> lines;
  std::map<std::string, std::string, std::less<>> notes;
};

} // namespace calibration
