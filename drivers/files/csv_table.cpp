// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/csv_table.hpp"
#include "drivers/files/decoded_text.hpp"
#include "drivers/files/workbook.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

/// Takes the line `sep=;` away, by which spreadsheets state the separator.
void take_separator_line(std::vector<Record>& records, TableFormat& format, const std::string& file) {
  if (records.empty() || records.front().line != 1) return;
  auto text = records.front().text;
  if (text.starts_with('"') && text.ends_with('"') && text.size() > 1) text = text.substr(1, text.size() - 2);
  if (!(text.starts_with("sep=") || text.starts_with("SEP=")) || text.size() < 5) return;
  if (text.size() > 5 || std::string_view("\t;, ").find(text[4]) == text.npos)
    throw std::runtime_error(
        fmt::format("{}:1: expected sep= and a tab, semicolon, comma or blank, found {}", file, shown(text)));
  if (!format.separator) format.separator = text[4];
  records.erase(records.begin());
}

/// A name in a list of names: control characters escaped, no quotes around it.
std::string shown_bare(const std::string& text) {
  const auto quoted = shown(text);
  return quoted.substr(1, quoted.size() - 2);
}

std::string lines_text(int first, int last) {
  return first == last ? fmt::format("line {}", first) : fmt::format("lines {} to {}", first, last);
}

} // namespace

CsvTable::CsvTable(const std::string& file_name, const TableFormat& wanted)
    : name(file_name), format(wanted) {
  const auto bytes = read_bytes(name);
  DecodedText decoded;
  if (is_workbook(bytes, name)) {
    decoded = {workbook_text(name, format.sheet), "a sheet of a workbook"};
    format.separator = ',';
    format.decimal = '.';
  } else {
    decoded = decode(bytes, name, format.encoding);
  }
  encoding = decoded.encoding;
  auto records = split_records(decoded.text, name);
  take_separator_line(records, format, name);
  read_notes(records);
  layout = find_layout(records, format, name);
}

void CsvTable::read_notes(const std::vector<Record>& records) {
  for (const auto& record : records) {
    const auto colon = record.text.find(':');
    if (record.comment && colon != record.text.npos)
      notes[std::string(trimmed(record.text.substr(1, colon - 1)))] = trimmed(record.text.substr(colon + 1));
  }
}

bool CsvTable::has(std::string_view wanted) const {
  return std::any_of(layout.headings.begin(), layout.headings.end(), [&](const auto& h) {
    return !wanted.empty() && (h.full == wanted || h.name == wanted);
  });
}

std::string CsvTable::column_names() const {
  constexpr std::size_t most = 12;
  Words names;
  for (const auto& h : layout.headings)
    if (!h.full.empty()) names.push_back(names.size() < most ? shown_bare(h.full) : "...");
  names.resize(std::min(names.size(), most + 1));
  return names.empty() ? fmt::format("{} columns without names", columns()) : joined(names);
}

std::size_t CsvTable::column(std::string_view wanted) const {
  if (!has(wanted))
    throw std::runtime_error(
        fmt::format("{}: expected a column {}, found {}", name, shown(wanted), column_names()));
  for (const bool by_full : {true, false}) {
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < columns(); ++c)
      if ((by_full ? layout.headings[c].full : layout.headings[c].name) == wanted) found.push_back(c);
    if (found.size() > 1)
      throw std::runtime_error(
          fmt::format("{}:{}: columns {} and {} are named {}: give the number of the column", name,
                      layout.names_line, found[0] + 1, found[1] + 1, shown(wanted)));
    if (found.size() == 1) return found[0];
  }
  return 0;
}

std::size_t CsvTable::column(long number) const {
  if (number < 1 || number > long(columns()))
    throw std::runtime_error(
        fmt::format("{}: expected a column from 1 to {}, found {}", name, columns(), number));
  return std::size_t(number - 1);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const auto& cell = text(row, column);
  const auto value = read_number(cell, layout.decimal);
  if (value && std::isfinite(*value)) return *value;
  const auto& full = layout.headings[column].full;
  const bool gap = layout.rows[row].kinds[column] == CellKind::gap;
  throw std::runtime_error(fmt::format("{}:{}: column {}: expected a finite number, found {}{}", name,
                                       line(row), full.empty() ? fmt::format("{}", column + 1) : shown(full),
                                       shown(cell), gap ? " (missing = \"skip\" drops such rows)" : ""));
}

std::vector<double> CsvTable::numbers(std::size_t column) const {
  std::vector<double> out;
  for (std::size_t row = 0; row < rows(); ++row) out.push_back(number(row, column));
  return out;
}

double CsvTable::note(std::string_view wanted) const {
  const auto found = notes.find(wanted);
  std::optional<double> value;
  if (found != notes.end()) value = read_number(found->second, '.');
  if (found != notes.end() && !value) value = read_number(found->second, layout.decimal);
  if (!value || !std::isfinite(*value))
    throw std::runtime_error(fmt::format("{}: no comment line '# {}: NUMBER' in this file", name, wanted));
  return *value;
}

void CsvTable::drop_gaps(const std::vector<std::size_t>& columns) {
  if (!format.skip_gaps) return;
  const auto has_gap = [&](const TableRow& row) {
    return std::any_of(columns.begin(), columns.end(), [&](auto c) { return row.kinds[c] == CellKind::gap; });
  };
  for (const auto& row : layout.rows)
    if (has_gap(row)) lines_with_gaps.push_back(row.line);
  std::erase_if(layout.rows, has_gap);
  if (layout.rows.empty()) throw std::runtime_error(name + ": each row has a gap in a column that is used");
}

std::string CsvTable::summary() const {
  std::string out = fmt::format("{}: {} rows, {}", name, rows(), lines_text(line(0), line(rows() - 1)));
  if (encoding.find(' ') != encoding.npos)
    out += ", " + encoding;
  else
    out += fmt::format(", {}{}, {}",
                       columns() > 1 ? "separated by " + separator_name(layout.separator) + ", " : "",
                       decimal_name(layout.decimal), encoding);
  out += "\n  columns:";
  for (std::size_t c = 0; c < columns(); ++c) {
    const auto& h = layout.headings[c];
    if (h.full.empty() && std::all_of(layout.rows.begin(), layout.rows.end(),
                                      [c](const auto& r) { return r.cells[c].empty(); }))
      continue;
    out += fmt::format("{} {} {}{}", c ? "," : "", c + 1, h.name.empty() ? "without a name" : shown(h.name),
                       h.unit.empty() ? "" : " [" + h.unit + "]");
  }
  for (const auto& d : layout.dropped)
    out += fmt::format("\n  dropped: {} ({})", lines_text(d.first, d.last), d.where);
  if (!lines_with_gaps.empty()) {
    Words lines;
    for (std::size_t i = 0; i < std::min<std::size_t>(lines_with_gaps.size(), 10); ++i)
      lines.push_back(fmt::format("{}", lines_with_gaps[i]));
    out += fmt::format("\n  skipped: {} rows with gaps (line {}{})", lines_with_gaps.size(), joined(lines),
                       lines_with_gaps.size() > lines.size() ? ", ..." : "");
  }
  return out + "\n";
}

} // namespace drivers
