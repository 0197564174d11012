// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_records.hpp"
#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace drivers {
namespace {

constexpr auto npos = std::string_view::npos;
constexpr std::string_view line_ends = "\r\n", blanks = " \t\r\n", no_break_space = "\xC2\xA0",
                           minus = "\xE2\x88\x92";
constexpr std::string_view missing[] = {"nan",  "NaN", "NAN",     "na",      "NA",    "n/a",
                                        "N/A",  "-",   "--",      "---",     "null",  "NULL",
                                        "#N/A", "#NV", "#DIV/0!", "#VALUE!", "#NUM!", "#REF!"};

/// Position after the quoted cell that begins at `at`: after its last quote. None if the text ends before.
std::size_t after_quoted(std::string_view text, std::size_t at) {
  for (at = text.find('"', at + 1); at != npos; at = text.find('"', at + 2))
    if (at + 1 == text.size() || text[at + 1] != '"') return at + 1;
  return npos;
}

bool opens_quote(std::string_view text, std::size_t begin, std::size_t at) {
  return text[at] == '"' && (at == begin || std::string_view(",;\t ").find(text[at - 1]) != npos);
}

/// End of the record that begins at `begin`: the first line end outside of quotes.
std::size_t record_end(std::string_view text, std::size_t begin) {
  for (std::size_t at = begin; at < text.size();) {
    if (line_ends.find(text[at]) != npos) return at;
    if (!opens_quote(text, begin, at)) {
      ++at;
      continue;
    }
    at = after_quoted(text, at);
    if (at == npos) return npos;
  }
  return text.size();
}

/// Line ends in a piece of text.
int count_lines(std::string_view text) {
  int count = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    count += text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
  return count;
}

bool is_comment(std::string_view record) {
  if (!record.starts_with('#')) return false;
  return std::none_of(std::begin(missing), std::end(missing), // a row whose first cell is a missing value
                      [&](auto word) { return word.starts_with('#') && record.starts_with(word); });
}

/// The cell that begins at `at`, and the position of the separator behind it (or the end).
std::string cut_cell(std::string_view record, std::size_t& at, std::string_view separators) {
  std::string out;
  while (at < record.size() && record[at] == ' ') ++at;
  if (at < record.size() && record[at] == '"')
    if (const auto end = after_quoted(record, at); end != npos) {
      for (std::size_t i = at + 1; i + 1 < end; ++i) {
        out += line_ends.find(record[i]) == npos ? record[i] : ' ';
        if (record[i] == '"') ++i; // the second of two
      }
      at = end;
    }
  const auto stop = std::min(record.find_first_of(separators, at), record.size());
  out += record.substr(at, stop - at);
  at = stop;
  return std::string(trimmed(out));
}

} // namespace

std::string_view trimmed(std::string_view text) {
  for (bool again = true; again;) {
    const auto first = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(first);
    const auto last = text.find_last_not_of(blanks);
    text = text.substr(0, last == npos ? 0 : last + 1);
    again = false;
    if (text.starts_with(no_break_space)) text.remove_prefix(no_break_space.size()), again = true;
    if (text.ends_with(no_break_space)) text.remove_suffix(no_break_space.size()), again = true;
  }
  return text;
}

std::string shown(std::string_view text) {
  std::size_t end = std::min<std::size_t>(text.size(), 60);
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
    ++end; // a whole character
  return quoted_text(std::string(text.substr(0, end)) + (end < text.size() ? "..." : ""));
}

std::vector<Record> split_records(std::string_view text, const std::string& file) {
  std::vector<Record> records;
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const auto first = text.find_first_not_of(" \t", at);
    if (first == npos) break;
    const bool comment = is_comment(text.substr(first));
    const auto end =
        comment ? std::min(text.find_first_of(line_ends, first), text.size()) : record_end(text, first);
    if (end == npos)
      throw std::runtime_error(fmt::format("{}:{}: a cell in this line begins with a quote and never ends: "
                                           "delete the quote, or close it",
                                           file, line));
    // A tab before the first word separates an empty cell from it.
    if (const auto record = text.substr(at, end - at); !trimmed(record).empty())
      records.push_back({line, comment ? trimmed(record) : record, comment});
    const auto next = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    line += count_lines(text.substr(at, std::min(next, text.size()) - at));
    at = next;
  }
  return records;
}

Words split_cells(std::string_view record, char separator) {
  Words out;
  if (separator == ' ') {
    for (auto at = record.find_first_not_of(blanks); at < record.size();
         at = record.find_first_not_of(blanks, at))
      out.push_back(cut_cell(record, at, blanks));
    return out;
  }
  for (std::size_t at = 0; at <= record.size(); ++at) out.push_back(cut_cell(record, at, {&separator, 1}));
  return out;
}

std::optional<double> read_number(std::string_view cell, char decimal) {
  std::string text(cell);
  if (text.starts_with(minus)) text.replace(0, minus.size(), "-");
  if (text.starts_with('+')) text.erase(0, 1);
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '.' && decimal == ',') return std::nullopt;
    if (text[i] == ',') {
      if (decimal != ',' || i == 0 || !digit(i - 1) || !digit(i + 1)) return std::nullopt;
      text[i] = '.';
    }
    if ((text[i] == 'd' || text[i] == 'D') && i > 0 && (digit(i - 1) || text[i - 1] == '.')) text[i] = 'e';
  }
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value != value) return std::nullopt;
  return value;
}

CellKind kind_of(std::string_view cell, char decimal) {
  if (cell.empty() || std::find(std::begin(missing), std::end(missing), cell) != std::end(missing))
    return CellKind::gap;
  if (read_number(cell, decimal)) return CellKind::number;
  const bool digits =
      cell.find_first_not_of("0123456789+-.,;eE \t") == npos && cell.find_first_of("0123456789") != npos;
  const bool parts = cell.find_first_of(".,; \t") != npos; // otherwise a name such as 2021-03-04
  const bool date = cell.size() >= 8 && std::count(cell.begin(), cell.end(), '.') == 2 &&
                    cell.find_first_not_of("0123456789.") == npos;
  return digits && parts && !date ? CellKind::broken : CellKind::text;
}

} // namespace drivers
