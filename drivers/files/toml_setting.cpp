// SPDX-License-Identifier: BSD-3-Clause
// Keys set from the command line.
#include "drivers/files/toml_document.hpp"
#include <charconv>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

/// The value as TOML; a text if it is none.
toml::table parsed(const std::string& value) {
  try {
    return toml::parse("value = " + value);
  } catch (const toml::parse_error&) {
    return toml::parse("value = " + quoted_text(value));
  }
}

Words parts_of(const std::string& key) {
  Words parts;
  for (std::size_t at = 0; at <= key.size();) {
    const auto end = std::min(key.find('.', at), key.size());
    parts.push_back(key.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

/// The table or array at a name, made if it is missing, or at a number (from 1) in an array; null without either.
toml::node* below(toml::node& from, const std::string& part) {
  toml::node* found = nullptr;
  if (auto* table = from.as_table()) {
    if (!table->contains(part)) table->insert(part, toml::table{});
    found = table->get(part);
  } else if (auto* array = from.as_array()) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    const bool whole = error == std::errc() && end == part.data() + part.size();
    if (whole && number >= 1 && number <= array->size()) found = array->get(number - 1);
  }
  return found && (found->is_table() || found->is_array()) ? found : nullptr;
}

} // namespace

void apply_setting(toml::table& root, const std::string& setting) {
  const auto fail = [&](const std::string& found) {
    throw std::runtime_error(
        fmt::format("--set {}: expected TABLE.KEY=VALUE of the file, found {}", setting, found));
  };
  const auto equals = setting.find('=');
  if (equals == setting.npos || equals == 0) fail("no KEY=VALUE");
  const auto parts = parts_of(setting.substr(0, equals));
  const auto value = parsed(setting.substr(equals + 1));
  toml::node* at = &root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    toml::node* next = below(*at, parts[i]);
    if (!next) fail(fmt::format("no table '{}'", parts[i]));
    at = next;
  }
  auto* table = at->as_table();
  if (!table || parts.back().empty()) fail(fmt::format("no table to hold '{}'", parts.back()));
  // New key and node carry no line number: they are not of the file.
  table->erase(parts.back());
  value.get("value")->visit([&](const auto& node) { table->insert(parts.back(), node); });
}

} // namespace drivers
