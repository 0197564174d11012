// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_rows.hpp"
#include <algorithm>

namespace drivers {
namespace {

/// Joins the kinds of a row to those of its block; false, without a change, if one contradicts them.
bool join(std::vector<CellKind>& block, const std::vector<CellKind>& row) {
  if (block.size() != row.size()) return false;
  const auto is_number = [](CellKind k) { return k == CellKind::number; };
  for (std::size_t c = 0; c < row.size(); ++c)
    if (block[c] != CellKind::gap && row[c] != CellKind::gap && is_number(block[c]) != is_number(row[c]))
      return false;
  for (std::size_t c = 0; c < row.size(); ++c)
    if (block[c] == CellKind::gap || row[c] == CellKind::broken) block[c] = row[c];
  return true;
}

} // namespace

bool TableRow::has_number() const {
  return std::find(kinds.begin(), kinds.end(), CellKind::number) != kinds.end();
}

bool TableRow::has_digits() const {
  return has_number() || std::find(kinds.begin(), kinds.end(), CellKind::broken) != kinds.end();
}

std::vector<TableRow> split_rows(const std::vector<Record>& records, char separator, char decimal) {
  std::vector<TableRow> rows;
  for (const auto& record : records) {
    if (record.comment) continue;
    TableRow row{record.line, split_cells(record.text, separator), {}};
    if (std::all_of(row.cells.begin(), row.cells.end(), [](const auto& cell) { return cell.empty(); }))
      continue;
    for (const auto& cell : row.cells) row.kinds.push_back(kind_of(cell, decimal));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::size_t RowBlock::numeric() const {
  return std::size_t(std::count(kinds.begin(), kinds.end(), CellKind::number));
}

std::vector<RowBlock> find_blocks(const std::vector<TableRow>& rows) {
  std::vector<RowBlock> blocks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!blocks.empty() && blocks.back().end == i && join(blocks.back().kinds, rows[i].kinds))
      blocks.back().end = i + 1;
    else if (rows[i].has_number())
      blocks.push_back({i, i + 1, rows[i].kinds});
  }
  return blocks;
}

RowBlock block_from(const std::vector<TableRow>& rows, std::size_t begin) {
  RowBlock block{begin, begin, {}};
  for (std::size_t i = begin; i < rows.size(); ++i) {
    const auto& kinds = rows[i].kinds;
    const bool gaps = std::all_of(kinds.begin(), kinds.end(), [](auto k) { return k == CellKind::gap; });
    if (rows[i].has_number() || (gaps && kinds.size() == rows[begin].kinds.size())) block.end = i + 1;
  }
  if (begin == block.end) return block;
  block.kinds.assign(rows[begin].kinds.size(), CellKind::gap);
  for (std::size_t i = begin; i < block.end; ++i)
    for (std::size_t c = 0; c < std::min(block.columns(), rows[i].kinds.size()); ++c)
      if (block.kinds[c] != CellKind::number && rows[i].kinds[c] != CellKind::gap)
        block.kinds[c] = rows[i].kinds[c];
  return block;
}

} // namespace drivers
