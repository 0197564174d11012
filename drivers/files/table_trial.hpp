// SPDX-License-Identifier: BSD-3-Clause
// One trial to read records as a table, with a given separator and decimal sign.
#pragma once
#include "drivers/files/table_layout.hpp"

namespace drivers {

struct LayoutTrial {
  std::optional<TableLayout> layout;
  std::string problem;     ///< why there is none: a line "FILE:LINE: ..."
  std::size_t numbers = 0; ///< cells of the table that are numbers
  bool separates = true;   ///< no cell holds numbers that another separator or decimal sign would part
};

LayoutTrial try_layout(const std::vector<Record>& records, char separator, char decimal,
                       const TableFormat& format, const std::string& file);

} // namespace drivers
