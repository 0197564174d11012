// SPDX-License-Identifier: BSD-3-Clause
// Finds how a table of text is laid out: separator, decimal sign, which lines hold names, units and numbers. What the
// file leaves open is an error that names the key of `TableFormat` which decides it; nothing is guessed.
#pragma once
#include "drivers/files/table_format.hpp"
#include "drivers/files/table_headings.hpp"
#include "drivers/files/table_rows.hpp"

namespace drivers {

/// Lines, from `first` to `last`, that are no part of the table.
struct DroppedLines {
  int first, last;
  std::string where; ///< "before the names"
};

struct TableLayout {
  char separator = ',', decimal = '.';
  int names_line = 0, units_line = 0; ///< 0: none
  std::vector<Heading> headings;      ///< one for each column; names are empty without a line of names
  std::vector<TableRow> rows;
  std::vector<DroppedLines> dropped;
};

/// The one layout in which the records are a table. Reads them with each separator and decimal sign that `format`
/// leaves open. Errors, "FILE:LINE: ...": no layout gives a table, or two give different ones.
TableLayout find_layout(const std::vector<Record>& records, const TableFormat& format,
                        const std::string& file);

} // namespace drivers
