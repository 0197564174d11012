// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/toml_document.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace drivers {
namespace {

/// toml++ reports a duplicate as "... cannot redefine existing TYPE 'NAME'".
std::string parse_error_line(const std::string& file, const toml::parse_error& error) {
  const std::string what(error.description());
  const auto line = error.source().begin.line;
  const auto first = what.find('\''), last = what.rfind('\'');
  if (what.find("cannot redefine existing") != what.npos && last != first)
    return fmt::format("{}:{}: {} '{}': expected one definition, found a second", file, line,
                       what.find("table") == what.npos ? "key" : "table",
                       what.substr(first + 1, last - first - 1));
  return fmt::format("{}:{}: expected valid TOML, found an error: {}", file, line, what);
}

} // namespace

std::string shown(const toml::node& node) {
  if (const auto* v = node.as_floating_point()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_integer()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_boolean()) return v->get() ? "true" : "false";
  if (const auto* v = node.as_string()) return quoted_text(v->get());
  if (const auto* v = node.as_array()) return fmt::format("an array of {}", v->size());
  return node.is_table() ? "a table" : "a date or time";
}

const toml::node* TomlTable::Node::find(std::string_view key) {
  if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
  return table->get(key);
}

void TomlTable::Node::record(std::string_view key, std::string value) {
  const auto at = std::find_if(used.begin(), used.end(), [&](const auto& u) { return u.first == key; });
  if (at != used.end())
    at->second = std::move(value);
  else
    used.emplace_back(key, std::move(value));
}

TomlTable TomlTable::Node::open(std::string_view key, const toml::table& below, bool in_array) {
  read.emplace_back(key);
  for (const auto& [header, t] : opened)
    if (t.node->table == &below) return t;
  const auto at = below.source().begin.line;
  return add(key, below, at ? at : line, in_array);
}

TomlTable TomlTable::Node::open_absent(std::string_view key) {
  static const toml::table empty;
  for (const auto& [header, t] : opened)
    if (t.node->name == dotted(name, key)) return t;
  return add(key, empty, line, false);
}

TomlTable TomlTable::Node::add(std::string_view key, const toml::table& below, unsigned at_line,
                               bool in_array) {
  const auto path = dotted(header, written_key(key));
  TomlTable result;
  result.node = std::make_shared<Node>(Node{document, &below, dotted(name, key), path, at_line});
  opened.emplace_back(in_array ? "[[" + path + "]]" : "[" + path + "]", result);
  return result;
}

TomlTable parse_toml(const std::string& text, const std::string& display_name, const std::string& folder,
                     const Words& settings) {
  auto document = std::make_shared<Document>(Document{display_name, text, folder, {}});
  try {
    document->root = toml::parse(std::string_view(text), std::string_view(display_name));
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(parse_error_line(display_name, error));
  }
  for (const auto& setting : settings) apply_setting(document->root, setting);
  TomlTable result;
  result.node = std::make_shared<TomlTable::Node>(TomlTable::Node{document, &document->root, "", ""});
  return result;
}

TomlTable read_toml(const std::string& file_name, const Words& settings) {
  std::ifstream file(file_name);
  std::stringstream text;
  if (!file || std::filesystem::is_directory(file_name) || !(text << file.rdbuf()))
    throw std::runtime_error(
        fmt::format("{}: expected a readable TOML file with content, found none", file_name));
  return parse_toml(text.str(), file_name, std::filesystem::path(file_name).parent_path().string(), settings);
}

} // namespace drivers
