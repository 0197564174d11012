// SPDX-License-Identifier: BSD-3-Clause
// The tables of a document, errors that name a place in it, and the account of what was used.
#include "drivers/files/toml_document.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {

bool TomlTable::has(std::string_view key) const {
  return node->find(key) != nullptr;
}

TomlTable TomlTable::table(std::string_view key) const {
  if (const auto found = optional_table(key)) return *found;
  fail(key, "a table", "no such table");
}

std::optional<TomlTable> TomlTable::optional_table(std::string_view key) const {
  const auto* found = node->find(key);
  if (!found) return std::nullopt;
  if (!found->is_table()) fail(key, "a table", shown(*found));
  return node->open(key, *found->as_table(), false);
}

TomlTable TomlTable::table_or_empty(std::string_view key) const {
  if (const auto found = optional_table(key)) return *found;
  return node->open_absent(key);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key, std::size_t at_least) const {
  std::vector<TomlTable> result;
  const auto* found = node->find(key);
  const auto expected = fmt::format("tables [[{}]]", dotted(node->name, key));
  if (!found && at_least > 0) fail(key, expected, "no such key");
  if (!found) return result;
  const auto* array = found->as_array();
  if (!array) fail(key, expected, shown(*found));
  node->read.emplace_back(key);
  for (const auto& element : *array) {
    if (!element.is_table()) fail(key, expected, shown(element));
    result.push_back(node->open(key, *element.as_table(), true));
  }
  if (result.size() < at_least)
    fail(key, fmt::format("at least {} {}", at_least, expected), fmt::format("{}", result.size()));
  return result;
}

void TomlTable::ignore(std::string_view key) const {
  if (node->find(key)) node->read.emplace_back(key);
}

Words TomlTable::keys() const {
  Words result;
  for (const auto& [key, value] : *node->table) result.emplace_back(key.str());
  return result;
}

void TomlTable::finish() const {
  for (const auto& [key, value] : *node->table) {
    if (std::find(node->read.begin(), node->read.end(), key.str()) != node->read.end()) continue;
    const auto nearest = nearest_word(key.str(), node->known);
    const auto expected =
        nearest.empty() ? std::string("a known key") : fmt::format("a known key such as '{}'", nearest);
    fail(key.str(), expected, "an unknown one");
  }
  for (const auto& [header, below] : node->opened) below.finish();
}

std::string TomlTable::where(std::string_view key) const {
  unsigned line = node->line;
  if (const auto at = node->table->find(key); !key.empty() && at != node->table->end())
    line = at->first.source().begin.line ? at->first.source().begin.line : at->second.source().begin.line;
  return line ? fmt::format("{}:{}", node->document->name, line)
              : fmt::format("{} (as set by the command)", node->document->name);
}

void TomlTable::fail(std::string_view key, const std::string& expected, const std::string& found) const {
  const bool absent = !node->table->contains(key);
  const auto place =
      !absent || node->name.empty() ? "" : fmt::format(" in table '{}' of line {}", node->name, node->line);
  throw std::runtime_error(fmt::format("{}: key '{}': expected {}, found {}{}", where(key),
                                       dotted(node->name, key), expected, found, place));
}

std::string TomlTable::resolved() const {
  std::string out;
  for (const auto& [key, value] : node->used) out += fmt::format("{} = {}\n", written_key(key), value);
  for (const auto& [header, below] : node->opened)
    out += fmt::format("{}{}\n{}", out.empty() ? "" : "\n", header, below.resolved());
  return out;
}

void TomlTable::absorb(std::string_view key, const TomlTable& other) const {
  std::erase_if(node->used, [&](const auto& u) { return u.first == key; });
  const auto own = node->used;
  for (const auto& [k, value] : other.node->used) node->record(k, value);
  for (const auto& [k, value] : own) node->record(k, value);
}

const std::string& TomlTable::name() const {
  return node->name;
}
const std::string& TomlTable::file_name() const {
  return node->document->name;
}
const std::string& TomlTable::source() const {
  return node->document->text;
}

} // namespace drivers
