// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/csv_table.hpp"
#include "drivers/toml_text.hpp"
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace calibration {
namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == text.npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> out;
  for (std::size_t from = 0;;) {
    const auto to = line.find(separator, from);
    out.push_back(trimmed(std::string_view(line).substr(from, to - from)));
    if (to == line.npos) return out;
    from = to + 1;
  }
}

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

} // namespace

CsvTable::CsvTable(const std::string& name, char separator) : file(name) {
  std::ifstream in(name);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", name));
  std::string line;
  for (long number = 1; std::getline(in, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3); // byte order mark
    const auto text = trimmed(line);
    if (text.empty()) continue;
    if (text.front() == '#') {
      if (const auto colon = text.find(':'); colon != text.npos)
        notes[trimmed(text.substr(1, colon - 1))] = trimmed(text.substr(colon + 1));
      continue;
    }
    auto row = split(line, separator);
    if (header.empty()) {
      header = std::move(row);
      for (const auto& column : header)
        if (std::count(header.begin(), header.end(), column) > 1)
          throw std::runtime_error(fmt::format("{}:{}: two columns are named '{}'", name, number, column));
      continue;
    }
    if (row.size() != header.size())
      throw std::runtime_error(fmt::format("{}:{}: expected {} cells as in the header, found {}", name,
                                           number, header.size(), row.size()));
    cells.push_back(std::move(row));
    lines.push_back(number);
  }
  if (cells.empty())
    throw std::runtime_error(fmt::format("{}: no rows of numbers below a header line", name));
}

bool CsvTable::has(std::string_view column) const {
  return std::find(header.begin(), header.end(), column) != header.end();
}

std::string CsvTable::column_names() const {
  return drivers::joined(header);
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  const auto place = std::find(header.begin(), header.end(), column) - header.begin();
  std::vector<double> out;
  for (std::size_t row = 0; row < cells.size(); ++row) {
    const auto value = finite_number(cells[row].at(place));
    if (!value)
      throw std::runtime_error(fmt::format("{}:{}: column '{}': expected a finite number, found \"{}\"", file,
                                           lines[row], column, cells[row][place]));
    out.push_back(*value);
  }
  return out;
}

double CsvTable::note(std::string_view name) const {
  const auto found = notes.find(name);
  const auto value = found == notes.end() ? std::nullopt : finite_number(found->second);
  if (!value)
    throw std::runtime_error(fmt::format("{}: no comment line '# {}: NUMBER' in this file", file, name));
  return *value;
}

} // namespace calibration
