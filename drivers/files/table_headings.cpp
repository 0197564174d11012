// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_headings.hpp"
#include "drivers/files/table_records.hpp"
#include "drivers/files/units.hpp"
#include <algorithm>

namespace drivers {
namespace {

bool in_brackets(std::string_view word) {
  return word.size() > 1 &&
         ((word.front() == '[' && word.back() == ']') || (word.front() == '(' && word.back() == ')'));
}

std::string_view without_brackets(std::string_view word) {
  return in_brackets(word) ? trimmed(word.substr(1, word.size() - 2)) : word;
}

/// The heading, if `unit` is one and something is left for the name.
std::optional<Heading> parted(const std::string& full, std::string_view name, std::string_view unit) {
  name = trimmed(name);
  unit = trimmed(unit);
  if (name.empty() || !find_unit(unit)) return std::nullopt;
  return Heading{full, std::string(name), std::string(unit)};
}

/// Joins each word in brackets, if there are others, to the word before it.
Words with_units(const Words& words) {
  if (std::all_of(words.begin(), words.end(), in_brackets)) return words;
  Words out;
  for (const auto& word : words)
    if (!out.empty() && in_brackets(word))
      out.back() += ' ' + word;
    else
      out.push_back(word);
  return out;
}

/// Joins "a", "=", "b" to one name; likewise "a / b".
Words with_definitions(const Words& words) {
  Words out;
  bool joins = false;
  for (const auto& word : words) {
    const bool sign = word == "=" || word == "/";
    if (!out.empty() && (sign || joins))
      out.back() += ' ' + word;
    else
      out.push_back(word);
    joins = sign;
  }
  return out;
}

/// Takes commas or semicolons away that end all words but the last: "a, b, c" above numbers between blanks.
void drop_commas(Words& words) {
  const bool all = std::all_of(words.begin(), words.end() - 1, [](const auto& w) {
    return w.size() > 1 && (w.back() == ',' || w.back() == ';');
  });
  if (all) std::for_each(words.begin(), words.end() - 1, [](auto& w) { w.pop_back(); });
}

bool fits(Words& cells, std::size_t columns, std::size_t may_lack) {
  while (cells.size() > columns && cells.back().empty()) cells.pop_back();
  if (cells.size() < columns && columns - cells.size() <= may_lack) cells.resize(columns);
  return cells.size() == columns;
}

} // namespace

Heading heading_of(const std::string& full) {
  const std::string_view text = full;
  for (const char open : {'[', '('})
    if (const auto at = text.rfind(open); at != text.npos && in_brackets(text.substr(at)))
      if (auto h = parted(full, text.substr(0, at), without_brackets(text.substr(at)))) return *h;
  for (const std::string_view between : {",", ";", " / ", " in "})
    if (const auto at = text.rfind(between); at != text.npos)
      if (auto h = parted(full, text.substr(0, at), text.substr(at + between.size()))) return *h;
  // A suffix of one letter may be an index: n_s, x_m.
  if (const auto at = text.rfind('_'); at != text.npos && at + 2 < text.size())
    if (auto h = parted(full, text.substr(0, at), text.substr(at + 1))) return *h;
  return {full, full, ""};
}

std::optional<Words> heading_cells(std::string_view line, char separator, std::size_t columns,
                                   std::size_t may_lack) {
  if (line.starts_with('#')) line = trimmed(line.substr(1));
  if (separator != ' ') {
    auto cells = split_cells(line, separator);
    if (fits(cells, columns, may_lack)) return cells;
    if (separator != '\t' || line.find('\t') != line.npos) return std::nullopt;
  }
  auto words = with_units(split_cells(line, ' '));
  if (words.size() > columns) words = with_definitions(words);
  if (words.size() != columns) return std::nullopt;
  drop_commas(words);
  return words;
}

std::optional<Words> unit_cells(const Words& cells) {
  Words out;
  bool is_sure = false;
  for (const auto& cell : cells) {
    const auto unit = without_brackets(cell);
    if (!unit.empty() && !find_unit(unit)) return std::nullopt;
    is_sure = is_sure || !(unit.empty() || cell == "1" || cell == "-");
    out.emplace_back(unit);
  }
  if (!is_sure) return std::nullopt;
  return out;
}

} // namespace drivers
