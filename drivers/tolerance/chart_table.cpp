// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/chart_table.hpp"
#include "drivers/files/csv_table.hpp"
#include "drivers/files/csv_write.hpp"

namespace drivers {
namespace {

constexpr auto header =
    "column,geometry,material,precision,stiffness_scale,step_factor,kernel,smoothing_length,resolution,"
    "repeat,"
    "failed,particles,steps,seconds,height,radius,rest_s,outline_error,dem_height_error,dem_radius_error,"
    "dem_outline_error";

/// Calls `f(name, number)` for the numbers of a row that may be unknown.
template <class Row, class F> void each_number(Row& row, F&& f) {
  f("particles", row.particles);
  f("steps", row.steps);
  f("seconds", row.seconds);
  f("height", row.height);
  f("radius", row.radius);
  f("rest_s", row.rest);
  f("outline_error", row.outline_error);
  f("dem_height_error", row.dem_height);
  f("dem_radius_error", row.dem_radius);
  f("dem_outline_error", row.dem_outline);
}

ChartRow row_of(const CsvTable& table, std::size_t k) {
  const auto number = [&](const char* name) { return table.number(k, table.column(name)); };
  const auto text = [&](const char* name) { return table.text(k, table.column(name)); };
  ChartRow row;
  row.column = text("column");
  row.configuration = {text("geometry"),           text("material"),      text("precision"),
                       number("stiffness_scale"),  number("step_factor"), text("kernel"),
                       number("smoothing_length"), number("resolution")};
  row.repeat = int(number("repeat"));
  row.failed = number("failed") != 0;
  each_number(row, [&](const char* name, double& value) {
    if (!text(name).empty()) value = number(name);
  });
  return row;
}

} // namespace

std::vector<ChartRow> read_chart_table(const std::filesystem::path& file) {
  const CsvTable table(file.string());
  std::vector<ChartRow> rows;
  for (std::size_t k = 0; k < table.rows(); ++k) rows.push_back(row_of(table, k));
  return rows;
}

void write_chart_table(const std::filesystem::path& file, const std::vector<ChartRow>& rows) {
  CsvWriter table(header);
  for (const auto& row : rows) {
    const auto& c = row.configuration;
    table.cell(row.column);
    for (const auto& choice : {c.geometry, c.material, c.precision}) table.cell(choice);
    for (const double choice : {c.stiffness_scale, c.step_factor}) table.cell(Rounded{choice});
    table.cell(c.kernel);
    for (const double choice : {c.smoothing_length, c.resolution}) table.cell(Rounded{choice});
    table.cell(row.repeat);
    table.cell(row.failed);
    each_number(row, [&](std::string_view name, double value) {
      table.cell(Rounded{value, name == "steps" || name == "particles" ? 9 : 5});
    });
    table.end_row();
  }
  table.write(file);
}

} // namespace drivers
