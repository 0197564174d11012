// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of TOML: every key must be asked for, every value must be in range, and every error
// is one line, `FILE:LINE: key 'table.key': expected ..., found ...`, thrown as std::runtime_error.
#pragma once
#include "drivers/files/toml_text.hpp"
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace drivers {

/// Bounds of a number, both included. Infinite and undefined numbers are never accepted.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};
inline constexpr Range any_number{};
inline constexpr Range positive{std::numeric_limits<double>::denorm_min()};
inline constexpr Range not_negative{0};

using NumberOrWord = std::variant<double, std::string>;

/// One table of a TOML document. Copies are handles to the same table. A key without a fallback is
/// required; reading a key marks it as known and records the value used.
class TomlTable {
public:
  bool has(std::string_view key) const;
  double number(std::string_view key, Range range = {}, std::optional<double> fallback = {}) const;
  long integer(std::string_view key, Range range = {}, std::optional<long> fallback = {}) const;
  bool flag(std::string_view key, std::optional<bool> fallback = {}) const;
  /// One of `words`; any text if `words` is empty.
  std::string text(std::string_view key, const Words& words = {},
                   std::optional<std::string> fallback = {}) const;
  NumberOrWord number_or_word(std::string_view key, Range range, const Words& words,
                              std::optional<NumberOrWord> fallback = {}) const;
  /// `count` numbers; any number of them if `count` is 0.
  std::vector<double> numbers(std::string_view key, std::size_t count = 0, Range range = {},
                              std::optional<std::vector<double>> fallback = {}) const;
  Words texts(std::string_view key, const Words& words = {}, std::optional<Words> fallback = {}) const;
  /// A file or folder; relative paths start at the folder of the document, `~` is not expanded.
  std::string path(std::string_view key, std::optional<std::string> fallback = {}) const;

  TomlTable table(std::string_view key) const;
  std::optional<TomlTable> optional_table(std::string_view key) const;
  /// As `table`; an absent one reads as empty, so that its keys take their fallbacks.
  TomlTable table_or_empty(std::string_view key) const;
  /// The tables `[[key]]`; an error if there are fewer than `at_least`.
  std::vector<TomlTable> tables(std::string_view key, std::size_t at_least = 0) const;

  /// Accepts a key without using its value.
  void ignore(std::string_view key) const;
  /// Keys of this table in alphabetical order, known or not. Reading them this way asks for none.
  Words keys() const;
  /// Throws on the first key, here or in a table below, that nothing asked for.
  void finish() const;
  /// Throws an error at `key` (or at the table itself if `key` is absent): "expected X, found Y".
  [[noreturn]] void fail(std::string_view key, const std::string& expected, const std::string& found) const;
  /// `FILE:LINE` of the key or, if it is absent, of the table.
  std::string where(std::string_view key = {}) const;

  /// The values used so far, fallbacks included, as TOML that reads identically: numbers to the last
  /// bit, paths absolute.
  std::string resolved() const;
  /// Takes over what was used of `other`, the document that this table's `key` names, so that `resolved`
  /// stands alone. Values of this table win.
  void absorb(std::string_view key, const TomlTable& other) const;
  const std::string& name() const;      ///< dotted name, empty at the root
  const std::string& file_name() const; ///< as given to read_toml or parse_toml
  const std::string& source() const;    ///< text of the whole document

private:
  struct Node;
  friend TomlTable parse_toml(const std::string&, const std::string&, const std::string&, const Words&);
  std::shared_ptr<Node> node;
};

/// Reads a file; its name is shown in errors as given. Each setting, KEY=VALUE, replaces or adds a key: dotted
/// names of tables, numbers (from 1) in arrays; the value as TOML, or a bare word for a text.
TomlTable read_toml(const std::string& file_name, const Words& settings = {});

/// Reads a text; `display_name` is shown in errors, relative paths start at `folder`.
TomlTable parse_toml(const std::string& text, const std::string& display_name,
                     const std::string& folder = ".", const Words& settings = {});

} // namespace drivers
