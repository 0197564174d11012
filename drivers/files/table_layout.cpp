// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_layout.hpp"
#include "drivers/files/table_trial.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <tuple>

namespace drivers {
namespace {

/// Separators to try, the rarest in numbers and names first; all give the same cells where a line has one cell.
std::vector<char> separators_of(const std::vector<Record>& records, const TableFormat& format) {
  if (format.separator) return {*format.separator};
  std::vector<char> out;
  for (const char c : {'\t', ';', ','})
    if (std::any_of(records.begin(), records.end(),
                    [c](const auto& r) { return r.text.find(c) != r.text.npos; }))
      out.push_back(c);
  out.push_back(' ');
  return out;
}

std::vector<char> decimals_of(const std::vector<Record>& records, const TableFormat& format) {
  if (format.decimal) return {*format.decimal};
  const bool comma = std::any_of(records.begin(), records.end(),
                                 [](const auto& r) { return r.text.find(',') != r.text.npos; });
  return comma ? std::vector<char>{'.', ','} : std::vector<char>{'.'};
}

/// The first cell that two layouts read differently: its line, and what each reads there.
struct Difference {
  int line;
  std::string first, second;
};

std::optional<Difference> difference(const TableLayout& a, const TableLayout& b) {
  for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i) {
    const auto &x = a.rows[i], &y = b.rows[i];
    bool same = x.line == y.line && x.kinds == y.kinds;
    for (std::size_t c = 0; same && c < x.cells.size(); ++c)
      same = read_number(x.cells[c], a.decimal) == read_number(y.cells[c], b.decimal);
    if (!same) return Difference{x.line, shown(joined(x.cells, " | ")), shown(joined(y.cells, " | "))};
  }
  if (a.rows.size() == b.rows.size()) return std::nullopt;
  return Difference{std::max(a.rows.back().line, b.rows.back().line), fmt::format("{} rows", a.rows.size()),
                    fmt::format("{} rows", b.rows.size())};
}

/// How near a trial that failed came to a table.
auto closeness(const LayoutTrial& trial) {
  return std::tuple(!trial.problem.empty(), trial.separates && trial.numbers > 0, trial.numbers);
}

[[noreturn]] void fail_ambiguous(const std::string& file, const TableLayout& a, const TableLayout& b,
                                 const Difference& d) {
  throw std::runtime_error(fmt::format(
      "{}:{}: two layouts are possible: separated by {} with a {} ({}), or separated by {} with a {} ({}): "
      "set the keys separator and decimal",
      file, d.line, separator_name(a.separator), decimal_name(a.decimal), d.first,
      separator_name(b.separator), decimal_name(b.decimal), d.second));
}

} // namespace

TableLayout find_layout(const std::vector<Record>& records, const TableFormat& format,
                        const std::string& file) {
  std::optional<TableLayout> found;
  LayoutTrial failed; // the closest
  for (const char separator : separators_of(records, format))
    for (const char decimal : decimals_of(records, format)) {
      auto trial = try_layout(records, separator, decimal, format, file);
      if (!trial.layout) {
        if (closeness(trial) > closeness(failed)) failed = std::move(trial);
        continue;
      }
      if (!found)
        found = std::move(trial.layout);
      else if (const auto d = difference(*found, *trial.layout))
        fail_ambiguous(file, *found, *trial.layout, *d);
    }
  std::size_t numbers = 0;
  if (found)
    for (const auto& row : found->rows)
      numbers += std::size_t(std::count(row.kinds.begin(), row.kinds.end(), CellKind::number));
  if (!found || (failed.separates && failed.numbers > numbers)) throw std::runtime_error(failed.problem);
  return std::move(*found);
}

} // namespace drivers
