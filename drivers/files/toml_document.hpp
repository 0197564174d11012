// SPDX-License-Identifier: BSD-3-Clause
// A document in memory and what was asked of its tables. For the sources of TomlTable alone: nothing else
// sees the library that parses.
#pragma once
#include "drivers/files/toml_table.hpp"
#include <filesystem>
#include <functional>
#include <toml++/toml.h>

namespace drivers {

struct Document {
  std::string name, text;
  std::filesystem::path folder;
  toml::table root;
};

/// A value in few words, for "found ...".
std::string shown(const toml::node& node);

/// Replaces or adds a key, KEY=VALUE. Throws std::runtime_error that names the setting.
void apply_setting(toml::table& root, const std::string& setting);

/// A table that was opened, with what was asked of it.
struct TomlTable::Node {
  std::shared_ptr<const Document> document;
  const toml::table* table;
  std::string name;                                        // dotted
  std::string header;                                      // as written in resolved(), empty at the root
  unsigned line = 1;                                       // 1-based
  Words known{};                                           // keys asked for
  Words read{};                                            // keys that were read
  std::vector<std::pair<std::string, std::string>> used{}; // key and value as TOML, in the order of asking
  std::vector<std::pair<std::string, TomlTable>> opened{}; // tables below

  /// The value of a key, which is known from now on; null if there is none.
  const toml::node* find(std::string_view key);
  /// Notes the value used for a key.
  void record(std::string_view key, std::string value);
  /// A handle to the table at `key`, the same one each time.
  TomlTable open(std::string_view key, const toml::table& below, bool in_array);
  /// As `open`, for a table that the document does not have.
  TomlTable open_absent(std::string_view key);

  /// The value converted, or the fallback, recorded as used.
  template <class T>
  T value(const TomlTable& self, std::string_view key, const std::optional<T>& fallback,
          const std::string& expected, const std::function<std::optional<T>(const toml::node&)>& convert,
          const std::function<std::string(const T&)>& write) {
    const auto* found = find(key);
    if (!found && !fallback) self.fail(key, expected, "no such key");
    const auto result = found ? convert(*found) : fallback;
    if (!result) self.fail(key, expected, shown(*found));
    if (found) read.emplace_back(key);
    record(key, write(*result));
    return *result;
  }

  /// A new handle below this table.
  TomlTable add(std::string_view key, const toml::table& below, unsigned at_line, bool in_array);
};

} // namespace drivers
