// SPDX-License-Identifier: BSD-3-Clause
// Lines of an ABAQUS input file as keyword blocks.
#pragma once
#include "tests/abaqus/deck_check.hpp"
#include <optional>
#include <string_view>

namespace deck {

struct DataLine {
  int line = 0;
  std::vector<std::string> items; ///< trimmed; quotes kept
};

struct Parameter {
  std::string name;                 ///< capitals
  std::optional<std::string> value; ///< capitals, unless quoted
};

struct Block {
  std::string keyword; ///< capitals, single blanks, no star
  int line = 0;
  std::vector<Parameter> parameters;
  std::vector<DataLine> data;

  const Parameter* parameter(std::string_view name) const;
  /// Its value, empty if it is absent or a flag.
  std::string value(std::string_view name) const;
};

std::vector<Block> read_blocks(const std::string& text, Findings& findings);

std::string capitals(std::string_view text);
std::optional<double> as_real(const std::string& item);
std::optional<long> as_integer(const std::string& item);
/// A letter, then letters, digits, `_` or `-`; at most 80. A dot would part an instance from its set.
bool is_label(const std::string& item);

} // namespace deck
