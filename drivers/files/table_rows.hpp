// SPDX-License-Identifier: BSD-3-Clause
// The rows of numbers in a file that holds other lines too: titles, names, units, footers.
#pragma once
#include "drivers/files/table_records.hpp"
#include <string>
#include <vector>

namespace drivers {

struct TableRow {
  int line;
  Words cells;
  std::vector<CellKind> kinds; ///< one for each cell
  bool has_number() const;
  bool has_digits() const; ///< a number, or a cell that other separators may part into numbers
};

/// Cells of all records that are no comments and not empty.
std::vector<TableRow> split_rows(const std::vector<Record>& records, char separator, char decimal);

/// Consecutive rows with as many cells each, in which every column holds numbers, or text, throughout, or gaps.
struct RowBlock {
  std::size_t begin = 0, end = 0; ///< positions of rows; `end` is the one after the last
  std::vector<CellKind> kinds;    ///< of the columns: gap where no row has anything
  std::size_t columns() const { return kinds.size(); }
  std::size_t numeric() const; ///< columns of numbers
  std::size_t rows() const { return end - begin; }
};

/// All blocks that hold a number, in their order.
std::vector<RowBlock> find_blocks(const std::vector<TableRow>& rows);

/// The rows from `begin` to the last that has a number or nothing but gaps, whatever the columns hold.
RowBlock block_from(const std::vector<TableRow>& rows, std::size_t begin);

} // namespace drivers
