// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_reading.hpp"
#include <algorithm>

namespace drivers {
namespace {

/// Columns at the end that hold nothing: the separator ends each line.
std::size_t empty_columns_at_end(const RowBlock& block) {
  std::size_t count = 0;
  while (count < block.columns() && block.kinds[block.columns() - 1 - count] == CellKind::gap) ++count;
  return count;
}

std::optional<Words> cells_above(const Reading& r, std::string_view line) {
  return heading_cells(line, r.out.separator, r.block.columns(), empty_columns_at_end(r.block));
}

/// Refuses a line above the table that may be a row of it, or that has not a name for each column.
Words require_names(const Reading& r, const TableRow& row) {
  const auto cells = cells_above(r, r.text_of(row.line));
  if (!cells && row.has_number())
    r.fail(
        row.line,
        fmt::format("expected {} cells, as the lines below, or names, found {}: state the line of the names "
                    "(names_line; 0: there is none)",
                    r.block.columns(), shown(r.text_of(row.line))));
  if (!cells)
    r.fail(r.first_row().line,
           fmt::format(
               "expected {} cells, as many as line {} has names, found {}: check separator and decimal, or "
               "state the line of the names (names_line; 0: there is none)",
               row.cells.size(), row.line, r.block.columns()));
  for (std::size_t c = 0; c < cells->size(); ++c)
    if (const auto kind = kind_of((*cells)[c], r.out.decimal);
        r.block.kinds[c] == CellKind::number && (kind == CellKind::number || kind == CellKind::broken))
      r.fail(row.line,
             fmt::format("expected a row of numbers or a line of names, found {}: state the line of the "
                         "names (names_line; 0: there is none)",
                         shown(r.text_of(row.line))));
  return *cells;
}

void set_headings(Reading& r, const Words& names, const std::optional<Words>& units) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    r.out.headings[c] = heading_of(names[c]);
    if (units && !(*units)[c].empty()) r.out.headings[c] = {names[c], names[c], (*units)[c]};
  }
}

/// Names by the line that the user gives, which may be a comment.
void read_given_names(Reading& r) {
  const auto cells_of = [&](int line) {
    const auto cells = cells_above(r, r.text_of(line));
    if (!cells) r.fail(line, fmt::format("expected a cell for each of {} columns", r.block.columns()));
    return *cells;
  };
  r.out.names_line = *r.format.names_line;
  std::optional<Words> units;
  r.out.units_line = r.format.units_line.value_or(0);
  if (!r.format.units_line && r.block.begin > 0 && r.rows[r.block.begin - 1].line > r.out.names_line)
    if (const auto cells = cells_above(r, r.text_of(r.rows[r.block.begin - 1].line));
        cells && unit_cells(*cells))
      r.out.units_line = r.rows[r.block.begin - 1].line;
  if (r.out.units_line > 0) units = unit_cells(cells_of(r.out.units_line));
  set_headings(r, cells_of(r.out.names_line), units);
}

struct LineAbove {
  int line;
  Words cells;
};

/// The lines above the table that may hold names and units, the nearest first: two rows, or two comments.
std::vector<LineAbove> lines_above(const Reading& r) {
  std::vector<LineAbove> above;
  if (r.block.begin > 0) {
    const auto& nearest = r.rows[r.block.begin - 1];
    above.push_back({nearest.line, require_names(r, nearest)});
    if (r.block.begin > 1)
      if (const auto cells = cells_above(r, r.text_of(r.rows[r.block.begin - 2].line)))
        above.push_back({r.rows[r.block.begin - 2].line, *cells});
    return above;
  }
  for (auto record = r.records.rbegin(); record != r.records.rend() && above.size() < 2; ++record) {
    if (!record->comment || record->line > r.first_row().line) continue;
    const auto cells = cells_above(r, record->text);
    if (!cells || record->text.find(": ") != record->text.npos) break; // a note is no line of names
    above.push_back({record->line, *cells});
  }
  return above;
}

void find_names(Reading& r) {
  const auto above = lines_above(r);
  if (above.empty()) return;
  const auto units_of = [&](std::size_t i) {
    return i < above.size() ? unit_cells(above[i].cells) : std::nullopt;
  };
  const auto near = units_of(0), far = units_of(1);
  // A single line of units is rather one of names that look like units: s, h.
  const std::size_t names = near && above.size() > 1 ? 1 : 0;
  r.out.names_line = above[names].line;
  if (above.size() > 1 && (near || far)) r.out.units_line = above[1 - names].line;
  set_headings(r, above[names].cells, names == 1 ? near : far);
}

} // namespace

void read_names(Reading& r) {
  if (r.format.names_line.value_or(0) > 0)
    read_given_names(r);
  else if (!r.format.names_line)
    find_names(r);
}

} // namespace drivers
