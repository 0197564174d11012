// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/csv_table.hpp"
#include "drivers/toml_text.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
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
  for (const char c : {',', ';', '\t'})
    if (header.find(c) != header.npos) return c;
  return ' ';
}

} // namespace

CsvTable::CsvTable(const std::string& file_name) : name(file_name) {
  std::ifstream file(file_name);
  if (!file || std::filesystem::is_directory(file_name))
    throw std::runtime_error(fmt::format("{}: expected a readable table, found none", file_name));
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3); // byte order mark
    const auto first = line.find_first_not_of(" \t\r");
    if (first == line.npos || line[first] == '#') continue;
    if (names.empty()) {
      separator = separator_of(line);
      names = split(line, separator);
      continue;
    }
    cells.push_back(split(line, separator));
    lines.push_back(number);
    if (cells.back().size() != names.size())
      throw std::runtime_error(
          fmt::format("{}:{}: expected {} cells, found {}", name, number, names.size(), cells.back().size()));
  }
  if (cells.empty())
    throw std::runtime_error(
        fmt::format("{}:{}: expected a line of column names and rows of numbers, found {}", name, number,
                    names.empty() ? "neither" : "no row"));
}

std::size_t CsvTable::column(const std::string& wanted) const {
  const auto count = std::count(names.begin(), names.end(), wanted);
  if (count != 1)
    throw std::runtime_error(
        fmt::format("{}: expected one column '{}', found {} among {}", name, wanted, count, joined(names)));
  return std::size_t(std::find(names.begin(), names.end(), wanted) - names.begin());
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const auto& text = cells[row][column];
  const char *begin = text.data() + text.starts_with('+'), *end = text.data() + text.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw std::runtime_error(fmt::format("{}:{}: column '{}': expected a finite number, found \"{}\"", name,
                                         lines[row], names[column], text));
  return value;
}

} // namespace drivers
