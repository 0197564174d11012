// SPDX-License-Identifier: BSD-3-Clause
// Lines and cells of a table of text. Quotes are those of RFC 4180: a cell that begins with a quote ends at the next
// single one, holds a quote as two, and may hold separators and line ends.
//
// Debian's libcsv splits by the same rules; it is not used because it reports neither line numbers nor blanks as
// separators, and the separator has to be known before.
#pragma once
#include "drivers/files/toml_text.hpp"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drivers {

/// One line that is not empty, or several where a quoted cell holds line ends.
struct Record {
  int line; ///< in the file, from 1
  std::string_view text;
  bool comment; ///< begins with #
};

/// Records of `text`, which must outlive them. Lines end with LF, CR LF or CR. An error, "FILE:LINE: ...", for a quoted
/// cell that does not end within `text`.
std::vector<Record> split_records(std::string_view text, const std::string& file);

/// Cells of a record without their quotes and the blanks around them. A blank as separator stands for runs of blanks
/// and tabs.
Words split_cells(std::string_view record, char separator);

/// Text without blanks, tabs, line ends and no-break spaces around it.
std::string_view trimmed(std::string_view text);

/// Text of the file for a message: in quotes, control characters escaped, at most about 60 characters.
std::string shown(std::string_view text);

enum class CellKind {
  gap,    ///< empty, or a word for a missing value: NaN, NA, n/a, #N/A, -
  number, ///< finite or infinite
  broken, ///< digits, signs, points, commas and blanks that are not one number
  text
};

CellKind kind_of(std::string_view cell, char decimal);

/// The number in a cell, infinite ones too: sign, digits, the decimal sign between digits if it is a comma, an
/// exponent after e, E, d or D.
std::optional<double> read_number(std::string_view cell, char decimal);

} // namespace drivers
