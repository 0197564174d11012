// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/measured_path.hpp"
#include "drivers/files/csv_table.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

constexpr double largest_strain = 3; // more is taken for a percentage read as a number

struct Unit {
  const char* name;
  char kind; ///< e strain, s stress, t time
  double size;
};
constexpr Unit units[] = {{"1", 'e', 1},     {"percent", 'e', 0.01}, {"permille", 'e', 1e-3}, {"Pa", 's', 1},
                          {"hPa", 's', 100}, {"kPa", 's', 1e3},      {"MPa", 's', 1e6},       {"s", 't', 1},
                          {"min", 't', 60},  {"h", 't', 3600}};

struct Column {
  std::size_t position;
  const LinearQuantity* quantity; ///< null: time
  double factor;                  ///< unit and sign
};

double read_factor(const TomlTable& table, char kind, double sign) {
  Words names;
  for (const auto& unit : units)
    if (unit.kind == kind) names.emplace_back(unit.name);
  const auto name = table.text("unit", names);
  const auto unit =
      std::find_if(std::begin(units), std::end(units), [&](const auto& u) { return u.name == name; });
  return kind == 't' ? unit->size : sign * unit->size;
}

double read_sign(const TomlTable& table, std::string fallback) {
  return table.text("compression", {"positive", "negative"}, std::move(fallback)) == "positive" ? 1 : -1;
}

std::vector<Column> read_columns(const TomlTable& table, const CsvTable& csv) {
  auto names = linear_quantity_names();
  names.emplace_back("time");
  const double sign = read_sign(table, "positive");
  std::vector<Column> columns;
  for (const auto& t : table.tables("columns", 1)) {
    const auto* quantity = find_linear_quantity(t.text("quantity", names));
    const char kind = !quantity ? 't' : quantity->is_strain ? 'e' : 's';
    const double own = quantity ? read_sign(t, sign > 0 ? "positive" : "negative") : 1;
    columns.push_back({csv.column(t.text("column")), quantity, read_factor(t, kind, own)});
  }
  return columns;
}

std::vector<MeasuredRow> read_rows(const CsvTable& csv, const std::vector<Column>& columns) {
  std::vector<MeasuredRow> rows;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    MeasuredRow row{csv.line(i), {}, 0};
    for (const auto& c : columns) {
      const double value = c.factor * csv.number(i, c.position);
      if (!c.quantity)
        row.time = value;
      else
        row.targets.push_back(value);
      if (c.quantity && c.quantity->is_strain && std::abs(value) > largest_strain)
        throw std::runtime_error(
            fmt::format("{}:{}: {}: expected a strain of at most {}, found {}: is its unit "
                        "right?",
                        csv.file(), row.line, c.quantity->name, largest_strain, value));
      if (!c.quantity && i > 0 && !(value > rows.back().time))
        throw std::runtime_error(fmt::format("{}:{}: expected a time after {} s, found {} s", csv.file(),
                                             row.line, rows.back().time, value));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Arc length of the path at each row, every column divided by its range.
std::vector<double> path_length(const std::vector<MeasuredRow>& rows) {
  const std::size_t n = rows.front().targets.size();
  std::vector<double> scale(n, 0.0), length{0};
  for (std::size_t c = 0; c < n; ++c) {
    const auto [low, high] = std::minmax_element(
        rows.begin(), rows.end(), [c](const auto& a, const auto& b) { return a.targets[c] < b.targets[c]; });
    const double range = high->targets[c] - low->targets[c];
    scale[c] = range > 0 ? 1 / range : 0;
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    double square = 0;
    for (std::size_t c = 0; c < n; ++c)
      square += std::pow(scale[c] * (rows[i].targets[c] - rows[i - 1].targets[c]), 2);
    length.push_back(length.back() + std::sqrt(square));
  }
  return length;
}

/// `points` rows at equal distances along the path; the first and the last are those of the path.
std::vector<MeasuredRow> resampled(const std::vector<MeasuredRow>& rows, long points) {
  const auto length = path_length(rows);
  std::vector<MeasuredRow> out;
  std::size_t i = 1;
  for (long k = 0; k < points; ++k) {
    const double at = length.back() * double(k) / double(points - 1);
    while (i + 1 < rows.size() && length[i] < at) ++i;
    const double piece = length[i] - length[i - 1];
    const double share = k == points - 1 ? 1 : piece > 0 ? (at - length[i - 1]) / piece : 0;
    MeasuredRow row = rows[i];
    for (std::size_t c = 0; c < row.targets.size(); ++c)
      row.targets[c] = std::lerp(rows[i - 1].targets[c], rows[i].targets[c], share);
    row.time = std::lerp(rows[i - 1].time, rows[i].time, share);
    out.push_back(std::move(row));
  }
  return out;
}

} // namespace

long MeasuredPath::increments(const std::vector<double>& from, const std::vector<double>& to) const {
  double count = double(substeps);
  for (std::size_t c = 0; c < driven.size(); ++c)
    if (driven[c]->is_strain && strain_increment > 0)
      count = std::max(count, std::ceil(std::abs(to[c] - from[c]) / strain_increment * (1 - 1e-9)));
  return long(count);
}

MeasuredPath read_measured_path(const TomlTable& table) {
  MeasuredPath out;
  out.file = table.path("file");
  const CsvTable csv(out.file);
  const auto columns = read_columns(table, csv);
  for (const auto& c : columns)
    if (c.quantity)
      out.driven.push_back(c.quantity);
    else if (out.timed)
      table.fail("columns", "one column of time", "two");
    else
      out.timed = true;
  if (out.driven.empty()) table.fail("columns", "a column that drives the stage", "none");
  out.rows = read_rows(csv, columns);
  if (table.text("zero_strain", {"first-row", "file"}, "first-row") == "first-row") {
    const auto first = out.rows.front().targets;
    for (auto& row : out.rows)
      for (std::size_t c = 0; c < first.size(); ++c)
        if (out.driven[c]->is_strain) row.targets[c] -= first[c];
  }
  if (table.has("points")) {
    const long points = table.integer("points", {2, 1e8});
    if (out.rows.size() < 2) table.fail("points", "a file of two rows or more", "one");
    out.rows = resampled(out.rows, points);
  }
  out.substeps = table.integer("substeps", {1, 1e6}, 1);
  out.strain_increment = table.has("strain_increment") ? table.number("strain_increment", positive) : 0;
  return out;
}

} // namespace drivers
