// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/csv_table.hpp"
#include "drivers/files/toml_text.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace drivers {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

/// Cells between separators; between runs of blanks if the separator is a blank.
Words split(const std::string& line, char separator) {
  Words out;
  if (separator != ' ') {
    for (std::size_t at = 0; at <= line.size();) {
      const auto end = std::min(line.find(separator, at), line.size());
      out.push_back(trimmed(line.substr(at, end - at)));
      at = end + 1;
    }
    return out;
  }
  for (auto at = line.find_first_not_of(" \t\r"); at != line.npos;) {
    const auto end = std::min(line.find_first_of(" \t\r", at), line.size());
    out.push_back(trimmed(line.substr(at, end - at)));
    at = line.find_first_not_of(" \t\r", end);
  }
  return out;
}

char separator_of(const std::string& header) {
  for (const char c : {'\t', ';', ','})
    if (header.find(c) != header.npos) return c;
  return ' ';
}

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

} // namespace

CsvTable::CsvTable(const std::string& file_name) : name(file_name) {
  std::ifstream file(file_name);
  if (!file || std::filesystem::is_directory(file_name))
    throw std::runtime_error(fmt::format("{}: expected a readable table, found none", file_name));
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3); // byte order mark
    take(line, number);
  }
  if (cells.empty())
    throw std::runtime_error(
        fmt::format("{}:{}: expected a line of column names and rows of numbers, found {}", name, number,
                    names.empty() ? "neither" : "no row"));
}

void CsvTable::take(const std::string& line, int number) {
  const auto first = line.find_first_not_of(" \t\r");
  if (first == line.npos) return;
  if (line[first] == '#') {
    if (const auto colon = line.find(':'); colon != line.npos)
      notes[trimmed(line.substr(first + 1, colon - first - 1))] = trimmed(line.substr(colon + 1));
    return;
  }
  if (names.empty()) {
    separator = separator_of(line);
    names = split(line, separator);
    for (const auto& column : names)
      if (std::count(names.begin(), names.end(), column) > 1)
        throw std::runtime_error(fmt::format("{}:{}: two columns are named '{}'", name, number, column));
    return;
  }
  cells.push_back(split(line, separator));
  lines.push_back(number);
  if (cells.back().size() != names.size())
    throw std::runtime_error(
        fmt::format("{}:{}: expected {} cells, found {}", name, number, names.size(), cells.back().size()));
}

bool CsvTable::has(std::string_view wanted) const {
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

std::string CsvTable::column_names() const {
  return joined(names);
}

std::size_t CsvTable::column(std::string_view wanted) const {
  if (!has(wanted))
    throw std::runtime_error(
        fmt::format("{}: expected a column '{}', found {}", name, wanted, column_names()));
  return std::size_t(std::find(names.begin(), names.end(), wanted) - names.begin());
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const auto& text = cells[row][column];
  if (const auto value = finite_number(text)) return *value;
  throw std::runtime_error(fmt::format("{}:{}: column '{}': expected a finite number, found \"{}\"", name,
                                       lines[row], names[column], text));
}

std::vector<double> CsvTable::numbers(std::string_view wanted) const {
  const auto place = column(wanted);
  std::vector<double> out;
  for (std::size_t row = 0; row < rows(); ++row) out.push_back(number(row, place));
  return out;
}

double CsvTable::note(std::string_view wanted) const {
  const auto found = notes.find(wanted);
  const auto value = found == notes.end() ? std::nullopt : finite_number(found->second);
  if (!value)
    throw std::runtime_error(fmt::format("{}: no comment line '# {}: NUMBER' in this file", name, wanted));
  return *value;
}

} // namespace drivers
