// SPDX-License-Identifier: BSD-3-Clause
// Names and units of the columns of a table, from the lines above its numbers.
#pragma once
#include "drivers/files/toml_text.hpp"
#include <optional>
#include <string>
#include <string_view>

namespace drivers {

struct Heading {
  std::string full; ///< as written
  std::string name; ///< without the unit
  std::string unit; ///< one that units.hpp knows; empty if the file gives none
};

/// Parts "eps [%]", "eps (%)", "eps, %", "eps / %", "eps in %" and "q_kPa". What is not a known unit stays in the name.
Heading heading_of(const std::string& text);

/// Cells of a line above the numbers, if there is one for each of `columns`. Lines of names are often separated by
/// blanks where the numbers have tabs: a word in brackets then belongs to the one before it, and "a = b" is one name.
/// Empty cells at the end are dropped, or added where `may_lack` allows so many.
std::optional<Words> heading_cells(std::string_view line, char separator, std::size_t columns,
                                   std::size_t may_lack);

/// Units, if each cell holds one, with or without brackets, or nothing. At least one must be other than "1" and "-",
/// which may be a number and a gap.
std::optional<Words> unit_cells(const Words& cells);

} // namespace drivers
