// SPDX-License-Identifier: BSD-3-Clause
// How a table of text is laid out, as far as the user says it. What is not said is found by the reader.
#pragma once
#include "drivers/files/toml_table.hpp"
#include <optional>
#include <string>

namespace drivers {

struct TableFormat {
  std::string encoding, sheet;
  std::optional<char> separator; ///< tab, semicolon, comma, or a blank for runs of blanks and tabs
  std::optional<char> decimal;   ///< point or comma
  std::optional<int> names_line; ///< line of the names of columns, from 1; 0: there is none
  std::optional<int> units_line, first_line, last_line; ///< last_line: of the numbers
  bool skip_gaps = false; ///< rows without one of the numbers that are used are dropped and counted
};

/// Reads the keys of a table `format`: manual in calibration/README.md.
TableFormat read_table_format(const TomlTable& table);

/// Words for a separator and a decimal sign, for messages: "semicolons", "decimal comma".
std::string separator_name(char separator);
std::string decimal_name(char decimal);

} // namespace drivers
