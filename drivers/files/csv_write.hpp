// SPDX-License-Identifier: BSD-3-Clause
// Writing of tables: comment lines, one line of column names, rows. Separator comma, texts in quotes where they need
// them (RFC 4180), numbers that are not finite as empty cells. `CsvTable` (csv_table.hpp) reads them back.
#pragma once
#include "drivers/files/toml_text.hpp"
#include <concepts>
#include <filesystem>
#include <ranges>
#include <string>
#include <string_view>

namespace drivers {

/// A number in a cell, with so many significant digits, as `%g` writes them; 17 digits keep every bit.
struct Rounded {
  double value;
  int digits = 6;
};

class CsvWriter {
public:
  /// Begins with the comments, as lines "# COMMENT", and the header: the names of the columns, separated by commas.
  explicit CsvWriter(std::string_view header, const Words& comments = {});

  /// One row. Cells are texts, whole numbers, truth values (1 or 0), `Rounded`, or ranges of these. Throws
  /// std::logic_error if there are not as many cells as columns.
  template <class... Cells> void row(const Cells&... cells) {
    (cell(cells), ...);
    end_row();
  }
  /// A row cell by cell.
  void cell(std::string_view text);
  void cell(Rounded number);
  void cell(std::integral auto number) { whole((long long)(number)); }
  template <std::ranges::input_range Cells>
  requires(!std::convertible_to<const Cells&, std::string_view>) void cell(const Cells& cells) {
    for (const auto& one : cells) cell(one);
  }
  void end_row();

  const std::string& text() const { return written; }
  /// The text since the last call, for tables that are written row by row.
  std::string take();
  /// Replaces the file. Throws std::system_error, which names it.
  void write(const std::filesystem::path& file) const;

private:
  void whole(long long number);
  void separate();
  std::string written;
  std::size_t columns = 0, cells = 0; ///< cells: of the row that is being written
};

} // namespace drivers
