// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_trial.hpp"
#include "drivers/files/table_reading.hpp"
#include <algorithm>

namespace drivers {
namespace {

/// A block shorter than this above the table, of other columns, is part of the title lines.
constexpr std::size_t shortest_table = 3;

/// First row of the table, where the user gives a line; a line of units below that of the names is none.
std::size_t given_start(const Reading& r) {
  const int above = std::max(r.format.names_line.value_or(0), r.format.units_line.value_or(0));
  const int line = r.format.first_line.value_or(above + 1);
  auto first = std::find_if(r.rows.begin(), r.rows.end(), [&](const auto& row) { return row.line >= line; });
  if (!r.format.first_line && !r.format.units_line && first != r.rows.end() && unit_cells(first->cells))
    ++first;
  return std::size_t(first - r.rows.begin());
}

/// The block of most rows among those with two columns of numbers or more; with one, if there are no others.
void choose_block(Reading& r) {
  if (r.starts_at_line()) {
    r.block = block_from(r.rows, given_start(r));
  } else {
    r.blocks = find_blocks(r.rows);
    const bool wide =
        std::any_of(r.blocks.begin(), r.blocks.end(), [](const auto& b) { return b.numeric() > 1; });
    if (wide) std::erase_if(r.blocks, [](const auto& b) { return b.numeric() < 2; });
    for (const auto& block : r.blocks)
      if (block.rows() > r.block.rows()) r.block = block;
  }
  if (r.block.rows() == 0)
    r.fail(r.rows.empty() ? 1 : r.rows.back().line,
           "expected rows of numbers between tabs, semicolons, commas or blanks, found none");
}

/// A cell of the table, as its row and column.
using CellPlace = std::pair<std::size_t, std::size_t>;

/// The first cell whose digits are not one number: the separator or the decimal sign is another one.
std::optional<CellPlace> broken_cell(const Reading& r) {
  for (std::size_t i = r.block.begin; i < r.block.end; ++i)
    for (std::size_t c = 0; c < r.rows[i].cells.size(); ++c)
      if (r.rows[i].kinds[c] == CellKind::broken) return CellPlace{i, c};
  return std::nullopt;
}

/// 1,234 is one thousand or one: an error if every comma may part thousands.
void require_decimal_commas(const Reading& r) {
  const TableRow* like_thousands = nullptr;
  std::string cell;
  for (std::size_t i = r.block.begin; i < r.block.end; ++i)
    for (std::size_t c = 0; c < r.rows[i].cells.size(); ++c) {
      const std::string_view text = r.rows[i].cells[c];
      const auto comma = text.find(',');
      if (r.rows[i].kinds[c] != CellKind::number || comma == text.npos) continue;
      const auto first = text.find_first_of("0123456789");
      const bool thousands = text.size() - comma == 4 && comma - first <= 3 && text[first] != '0' &&
                             text.find_first_not_of("0123456789", comma + 1) == text.npos;
      if (!thousands) return;
      like_thousands = &r.rows[i];
      cell = text;
    }
  if (like_thousands)
    r.fail(like_thousands->line,
           fmt::format("{} may be a number with a decimal comma or one with its thousands "
                       "parted: remove such commas from the file, or set decimal = \"comma\"",
                       shown(cell)));
}

/// Other lines with numbers: part of the title if they are few and have other columns, otherwise an error.
void check_rows_above(const Reading& r) {
  for (const auto& block : r.blocks) {
    if (block.begin >= r.block.begin) break;
    if (block.columns() != r.block.columns() && block.rows() < shortest_table) continue;
    r.fail(
        r.rows[block.begin].line,
        fmt::format(
            "numbers in lines {} to {} and in lines {} to {}: choose the table by first_line and last_line",
            r.rows[block.begin].line, r.rows[block.end - 1].line, r.first_row().line,
            r.rows[r.block.end - 1].line));
  }
}

std::string column_label(const Reading& r, std::size_t c) {
  const auto& name = r.out.headings[c].full;
  return name.empty() ? fmt::format("column {}", c + 1) : fmt::format("column {}", shown(name));
}

/// Refuses a row of the block, or below it, that does not fit.
[[noreturn]] void fail_row(const Reading& r, const TableRow& row) {
  if (row.cells.size() != r.block.columns())
    r.fail(row.line, fmt::format("expected {} cells, found {} (last_line ends the table above)",
                                 r.block.columns(), row.cells.size()));
  for (std::size_t c = 0; c < row.cells.size(); ++c)
    if (r.block.kinds[c] == CellKind::number && row.kinds[c] != CellKind::number &&
        row.kinds[c] != CellKind::gap)
      r.fail(row.line, fmt::format("{}: expected a finite number, found {} (last_line ends the table above)",
                                   column_label(r, c), shown(row.cells[c])));
  for (std::size_t c = 0; c < row.cells.size(); ++c)
    if (r.block.kinds[c] != CellKind::number && row.kinds[c] == CellKind::number)
      r.fail(row.line, fmt::format("{}: expected a text, as above, found {} (names_line allows both)",
                                   column_label(r, c), shown(row.cells[c])));
  r.fail(row.line, "numbers again after other lines: choose the table by first_line and last_line");
}

void check_rows_below(const Reading& r) {
  for (std::size_t i = r.block.begin; i < r.block.end; ++i)
    if (r.rows[i].cells.size() != r.block.columns()) fail_row(r, r.rows[i]);
  for (std::size_t i = r.block.end; i < r.rows.size(); ++i)
    if (r.rows[i].has_digits()) fail_row(r, r.rows[i]);
}

/// A file of one column whose name holds a separator is rather one of several columns.
void check_single_column(const Reading& r) {
  if (r.block.columns() == 1 && !r.format.separator &&
      r.out.headings[0].full.find_first_of(",;\t") != std::string::npos)
    r.fail(r.out.names_line, "expected the name of one column, found a separator");
}

void list_dropped(Reading& r) {
  const auto& out = r.out;
  int top = r.first_row().line;
  for (const int line : {out.names_line, out.units_line})
    if (line > 0) top = std::min(top, line);
  const auto below =
      std::find_if(r.rows.begin(), r.rows.end(), [top](const auto& row) { return row.line >= top; });
  if (below != r.rows.begin())
    r.out.dropped.push_back({r.rows.front().line, (below - 1)->line, "above the table"});
  if (r.block.end < r.rows.size())
    r.out.dropped.push_back({r.rows[r.block.end].line, r.rows.back().line, "below the table"});
}

void read_table(Reading& r, LayoutTrial& trial) {
  choose_block(r);
  for (std::size_t i = r.block.begin; i < r.block.end; ++i)
    trial.numbers +=
        std::size_t(std::count(r.rows[i].kinds.begin(), r.rows[i].kinds.end(), CellKind::number));
  const bool given = r.format.separator && r.format.decimal;
  if (const auto broken = broken_cell(r); broken && !given) {
    trial.separates = false;
    const auto& [i, c] = *broken;
    r.fail(r.rows[i].line,
           fmt::format("column {}: expected a number or a text, found {}", c + 1, shown(r.rows[i].cells[c])));
  }
  if (r.out.decimal == ',' && !r.format.decimal) require_decimal_commas(r);
  r.out.headings.resize(r.block.columns());
  read_names(r);
  check_single_column(r);
  check_rows_above(r);
  check_rows_below(r);
  list_dropped(r);
}

} // namespace

LayoutTrial try_layout(const std::vector<Record>& records, char separator, char decimal,
                       const TableFormat& format, const std::string& file) {
  LayoutTrial trial;
  Reading r{records, format, file, split_rows(records, separator, decimal), {}, {}, {}};
  r.out.separator = separator;
  r.out.decimal = decimal;
  if (format.last_line) std::erase_if(r.rows, [&](const auto& row) { return row.line > *format.last_line; });
  try {
    read_table(r, trial);
  } catch (const std::runtime_error& error) {
    trial.problem = error.what();
    return trial;
  }
  r.out.rows.assign(std::make_move_iterator(r.rows.begin() + long(r.block.begin)),
                    std::make_move_iterator(r.rows.begin() + long(r.block.end)));
  trial.layout = std::move(r.out);
  return trial;
}

} // namespace drivers
