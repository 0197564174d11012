// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/toml_table.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <toml++/toml.h>

namespace drivers {
namespace {

struct Document {
  std::string name, text;
  std::filesystem::path folder;
  toml::table root;
};

std::string quoted_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", int(c));
    else
      out += c;
  return out + '"';
}

/// A key as written: bare where TOML allows it.
std::string written_key(std::string_view key) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), bare) ? std::string(key) : quoted_text(key);
}

std::string dotted(const std::string& table, std::string_view key) {
  return table.empty() ? std::string(key) : table + '.' + std::string(key);
}

/// A value in few words, for "found ...".
std::string shown(const toml::node& node) {
  if (const auto* v = node.as_floating_point()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_integer()) return fmt::format("{}", v->get());
  if (const auto* v = node.as_boolean()) return v->get() ? "true" : "false";
  if (const auto* v = node.as_string()) return quoted_text(v->get());
  if (const auto* v = node.as_array()) return fmt::format("an array of {}", v->size());
  return node.is_table() ? "a table" : "a date or time";
}

std::string described(Range r) {
  const bool below = std::isfinite(r.lower), above = std::isfinite(r.upper),
             beyond_zero = r.lower == positive.lower;
  if (beyond_zero && above) return fmt::format(" above 0 and at most {}", r.upper);
  if (beyond_zero) return " above 0";
  if (below && above) return fmt::format(" from {} to {}", r.lower, r.upper);
  if (below) return fmt::format(" of at least {}", r.lower);
  return above ? fmt::format(" of at most {}", r.upper) : "";
}

std::string described(const Words& words) {
  if (words.empty()) return "a text";
  Words quotes;
  for (const auto& w : words) quotes.push_back(quoted_text(w));
  return fmt::format("{}{}", words.size() > 1 ? "one of " : "", joined(quotes));
}

std::optional<double> number_in(const toml::node& node, Range range) {
  const auto value = node.value<double>();
  const bool is_number = node.is_number() && value && std::isfinite(*value);
  return is_number && *value >= range.lower && *value <= range.upper ? value : std::nullopt;
}

std::optional<std::string> word_in(const toml::node& node, const Words& words) {
  const auto value = node.value_exact<std::string>();
  const bool allowed =
      words.empty() || (value && std::find(words.begin(), words.end(), *value) != words.end());
  return allowed ? value : std::nullopt;
}

std::string written(double v) {
  return toml_number(v);
}
std::string written(const std::string& v) {
  return quoted_text(v);
}
template <class T> std::string written(const std::vector<T>& values) {
  std::vector<std::string> parts;
  for (const auto& v : values) parts.push_back(written(v));
  return fmt::format("[{}]", joined(parts));
}

/// Levenshtein distance: edits that turn one key into the other.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replace = corner + (a[i] != b[j]);
      corner = row[j + 1];
      row[j + 1] = std::min({replace, corner + 1, row[j] + 1});
    }
  }
  return row.back();
}

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

/// A table that was opened, with what was asked of it.
struct TomlTable::Node {
  std::shared_ptr<const Document> document;
  const toml::table* table;
  std::string name;                                      // dotted
  std::string header;                                    // as written in resolved(), empty at the root
  unsigned line = 1;                                     // 1-based
  std::vector<std::string> known;                        // keys asked for
  std::vector<std::string> read;                         // keys that were read
  std::vector<std::pair<std::string, std::string>> used; // key and value as TOML, in the order of asking
  std::vector<std::pair<std::string, TomlTable>> opened; // tables below

  const toml::node* find(std::string_view key) {
    if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
    return table->get(key);
  }

  void record(std::string_view key, std::string value) {
    const auto at = std::find_if(used.begin(), used.end(), [&](const auto& u) { return u.first == key; });
    if (at != used.end())
      at->second = std::move(value);
    else
      used.emplace_back(key, std::move(value));
  }

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

  TomlTable open(std::string_view key, const toml::table& below, bool in_array) {
    read.emplace_back(key);
    const auto path = dotted(header.empty() ? "" : header, written_key(key));
    for (const auto& [k, t] : opened)
      if (t.node->table == &below) return t;
    TomlTable result;
    const auto at = below.source().begin.line;
    result.node = std::make_shared<Node>(
        Node{document, &below, dotted(name, key), path, at ? at : line, {}, {}, {}, {}});
    opened.emplace_back(in_array ? "[[" + path + "]]" : "[" + path + "]", result);
    return result;
  }
};

bool TomlTable::has(std::string_view key) const {
  return node->find(key) != nullptr;
}

double TomlTable::number(std::string_view key, Range range, std::optional<double> fallback) const {
  return node->value<double>(
      *this, key, fallback, "a number" + described(range),
      [&](const toml::node& n) { return number_in(n, range); }, toml_number);
}

long TomlTable::integer(std::string_view key, Range range, std::optional<long> fallback) const {
  return node->value<long>(
      *this, key, fallback, "an integer" + described(range),
      [&](const toml::node& n) {
        return n.is_integer() && number_in(n, range) ? std::optional<long>(n.value<long>()) : std::nullopt;
      },
      [](long v) { return fmt::format("{}", v); });
}

bool TomlTable::flag(std::string_view key, std::optional<bool> fallback) const {
  return node->value<bool>(
      *this, key, fallback, "true or false", [](const toml::node& n) { return n.value_exact<bool>(); },
      [](bool v) { return v ? "true" : "false"; });
}

std::string TomlTable::text(std::string_view key, const Words& words,
                            std::optional<std::string> fallback) const {
  return node->value<std::string>(
      *this, key, fallback, described(words), [&](const toml::node& n) { return word_in(n, words); },
      quoted_text);
}

NumberOrWord TomlTable::number_or_word(std::string_view key, Range range, const Words& words,
                                       std::optional<NumberOrWord> fallback) const {
  return node->value<NumberOrWord>(
      *this, key, fallback, fmt::format("a number{} or {}", described(range), described(words)),
      [&](const toml::node& n) -> std::optional<NumberOrWord> {
        if (const auto number = number_in(n, range)) return *number;
        if (const auto word = word_in(n, words)) return *word;
        return std::nullopt;
      },
      [](const NumberOrWord& v) { return std::visit([](const auto& x) { return written(x); }, v); });
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, Range range,
                                       std::optional<std::vector<double>> fallback) const {
  const auto expected = fmt::format("an array of {}numbers{}", count ? fmt::format("{} ", count) : "",
                                    range.lower == any_number.lower ? "" : ", each" + described(range));
  return node->value<std::vector<double>>(
      *this, key, fallback, expected,
      [&](const toml::node& n) -> std::optional<std::vector<double>> {
        const auto* array = n.as_array();
        if (!array || (count && array->size() != count)) return std::nullopt;
        std::vector<double> values;
        for (const auto& element : *array)
          if (const auto v = number_in(element, range))
            values.push_back(*v);
          else
            fail(key, expected, fmt::format("element {}: {}", values.size() + 1, shown(element)));
        return values;
      },
      [](const std::vector<double>& v) { return written(v); });
}

Words TomlTable::texts(std::string_view key, const Words& words, std::optional<Words> fallback) const {
  const auto expected = words.empty() ? "an array of texts" : "an array, each element " + described(words);
  return node->value<Words>(
      *this, key, fallback, expected,
      [&](const toml::node& n) -> std::optional<Words> {
        const auto* array = n.as_array();
        if (!array) return std::nullopt;
        Words values;
        for (const auto& element : *array)
          if (const auto v = word_in(element, words))
            values.push_back(*v);
          else
            fail(key, expected, fmt::format("element {}: {}", values.size() + 1, shown(element)));
        return values;
      },
      [](const Words& v) { return written(v); });
}

std::string TomlTable::path(std::string_view key, std::optional<std::string> fallback) const {
  const auto given = text(key, {}, std::move(fallback));
  if (given.empty()) fail(key, "a path", "\"\"");
  const auto resolved = std::filesystem::absolute(node->document->folder / given).lexically_normal().string();
  node->record(key, quoted_text(resolved));
  return resolved;
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
  static const toml::table empty;
  if (const auto found = optional_table(key)) return *found;
  for (const auto& [header, t] : node->opened)
    if (t.node->name == dotted(node->name, key)) return t;
  TomlTable result;
  const auto path = dotted(node->header, written_key(key));
  result.node = std::make_shared<Node>(
      Node{node->document, &empty, dotted(node->name, key), path, node->line, {}, {}, {}, {}});
  node->opened.emplace_back("[" + path + "]", result);
  return result;
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
    std::string nearest;
    std::size_t distance = std::max<std::size_t>(2, key.str().size() / 3) + 1;
    for (const auto& candidate : node->known)
      if (const auto d = edits(key.str(), candidate); d > 0 && d < distance)
        distance = d, nearest = candidate;
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
  return fmt::format("{}:{}", node->document->name, line);
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

TomlTable parse_toml(const std::string& text, const std::string& display_name, const std::string& folder) {
  auto document = std::make_shared<Document>(Document{display_name, text, folder, {}});
  try {
    document->root = toml::parse(std::string_view(text), std::string_view(display_name));
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(parse_error_line(display_name, error));
  }
  TomlTable result;
  result.node = std::make_shared<TomlTable::Node>(
      TomlTable::Node{document, &document->root, "", "", 1, {}, {}, {}, {}});
  return result;
}

TomlTable read_toml(const std::string& file_name) {
  std::ifstream file(file_name);
  std::stringstream text;
  if (!file || std::filesystem::is_directory(file_name) || !(text << file.rdbuf()))
    throw std::runtime_error(
        fmt::format("{}: expected a readable TOML file with content, found none", file_name));
  return parse_toml(text.str(), file_name, std::filesystem::path(file_name).parent_path().string());
}

std::string joined(const Words& texts, std::string_view separator) {
  std::string out;
  for (const auto& text : texts) out.append(out.empty() ? "" : separator).append(text);
  return out;
}

std::string toml_number(double value) {
  const auto text = fmt::format("{}", value); // shortest text that reads back to the same bits
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

} // namespace drivers
