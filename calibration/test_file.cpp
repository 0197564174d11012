// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/test_file.hpp"
#include "drivers/files/csv_table.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace calibration {
namespace {

using drivers::CsvTable;
using drivers::TomlTable;
using drivers::Words;

Words kind_names() {
  Words names;
  for (const auto& test : drivers::axisymmetric_tests()) names.emplace_back(test.name);
  return names;
}

Words measure_names() {
  Words names;
  for (const auto& m : measures) names.emplace_back(m.key);
  return names;
}

Measure measure_named(const std::string& name) {
  for (std::size_t m = 0; m < measures.size(); ++m)
    if (measures[m].key == name) return Measure(m);
  throw std::logic_error("no measure " + name);
}

/// Factor from the declared unit of a stress, a strain or a ratio to SI.
double read_unit(const TomlTable& table, bool stress) {
  const auto unit = stress ? table.text("unit", {"Pa", "kPa", "MPa"}) : table.text("unit", {"1", "%"});
  return unit == "MPa" ? 1e6 : unit == "kPa" ? 1e3 : unit == "%" ? 0.01 : 1;
}

/// Converts engineering strain, a change of length or volume over the initial one, to logarithmic strain.
void to_logarithmic(std::vector<double>& values, const TomlTable& table, const CsvTable& csv,
                    const std::string& column) {
  if (table.text("strain", {"engineering", "logarithmic"}) == "logarithmic") return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] < 1))
      throw std::runtime_error(
          fmt::format("{}:{}: column '{}': an engineering strain of {} is 100 % or more: check the "
                      "column and its unit",
                      csv.file(), csv.line(i), column, values[i]));
    values[i] = -std::log1p(-values[i]);
  }
}

std::vector<double> read_column(const TomlTable& table, const CsvTable& csv, bool stress, bool strain,
                                bool volumetric) {
  const auto column = table.text("column");
  if (!csv.has(column))
    table.fail("column", fmt::format("a column of {}: {}", csv.file(), csv.column_names()),
               fmt::format("\"{}\"", column));
  auto values = csv.numbers(column);
  double factor = read_unit(table, stress);
  if (volumetric && table.text("positive", {"contraction", "dilation"}) == "dilation") factor = -factor;
  if (!volumetric && (strain || stress) &&
      table.text("positive", {"compression", "extension"}, "compression") == "extension")
    factor = -factor;
  for (double& v : values) v *= factor;
  if (strain) to_logarithmic(values, table, csv, column);
  return values;
}

/// Axial strain of an oedometer test: without radial strain it follows from the void ratio.
std::vector<double> strain_of_void_ratio(const std::vector<double>& e, double e0) {
  std::vector<double> out;
  for (double v : e) out.push_back(std::log((1 + e0) / (1 + v)));
  return out;
}

RawCurves read_curves(const TomlTable& columns, const CsvTable& csv, const Specimen& specimen) {
  RawCurves raw;
  for (std::size_t m = 0; m < measures.size(); ++m) {
    const auto spec = columns.optional_table(measures[m].key);
    if (!spec) continue;
    const bool volumetric = Measure(m) == Measure::volumetric_strain;
    raw.given[m] = read_column(*spec, csv, measures[m].unit == "Pa", volumetric, volumetric);
  }
  const auto& e = raw.given[std::size_t(Measure::void_ratio)];
  if (const auto axial = columns.optional_table("axial_strain"))
    raw.strain = read_column(*axial, csv, false, true, false);
  else if (specimen.kind->holds("radial_strain") && e)
    raw.strain = strain_of_void_ratio(*e, specimen.void_ratio);
  else
    columns.fail("axial_strain", "a table {column, unit, strain}", "no such table");
  return raw;
}

/// A curve that is a column or follows from columns; empty if neither.
std::vector<double> curve_of(const RawCurves& raw, const Specimen& specimen, Measure measure) {
  const auto& given = raw.given[std::size_t(measure)];
  if (given) return *given;
  const auto has = [&](Measure m) -> const std::vector<double>* {
    const auto& values = raw.given[std::size_t(m)];
    return values ? &*values : nullptr;
  };
  std::vector<double> out(raw.strain.size());
  const auto fill = [&](auto f) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = f(i);
    return out;
  };
  const auto *q = has(Measure::deviatoric_stress), *p = has(Measure::mean_stress),
             *axial = has(Measure::axial_stress), *radial = has(Measure::radial_stress),
             *volume = has(Measure::volumetric_strain), *e = has(Measure::void_ratio);
  const bool cell = specimen.kind->holds("radial_stress");
  const double e0 = specimen.void_ratio, held = specimen.radial_stress;
  if (measure == Measure::deviatoric_stress) {
    if (axial && radial) return fill([&](auto i) { return (*axial)[i] - (*radial)[i]; });
    if (axial && cell) return fill([&](auto i) { return (*axial)[i] - held; });
  }
  if (measure == Measure::stress_ratio) {
    if (q && p) return fill([&](auto i) { return (*q)[i] / (*p)[i]; });
    if (axial && radial)
      return fill(
          [&](auto i) { return 3 * ((*axial)[i] - (*radial)[i]) / ((*axial)[i] + 2 * (*radial)[i]); });
    if (q && cell) return fill([&](auto i) { return (*q)[i] / (held + (*q)[i] / 3); });
  }
  if (measure == Measure::volumetric_strain && e)
    return fill([&](auto i) { return std::log((1 + e0) / (1 + (*e)[i])); });
  if (measure == Measure::void_ratio && volume)
    return fill([&](auto i) { return (1 + e0) * std::exp(-(*volume)[i]) - 1; });
  return {};
}

/// A number, or the name of a comment line of the file that holds it.
double read_number_or_note(const TomlTable& table, const char* key, const char* note_key,
                           drivers::Range range, const std::optional<CsvTable>& csv) {
  if (!csv || !table.has(note_key)) return table.number(key, range);
  if (table.has(key)) table.fail(key, fmt::format("only one of {}, {}", key, note_key), "both");
  const double value = csv->note(table.text(note_key));
  if (!(value >= range.lower && value <= range.upper))
    table.fail(note_key, fmt::format("a number from {} to {}", range.lower, range.upper),
               fmt::format("{}", value));
  return value;
}

Specimen read_specimen(const TomlTable& table, const std::optional<CsvTable>& csv) {
  Specimen s;
  s.kind = drivers::find_axisymmetric_test(table.text("kind", kind_names()));
  s.void_ratio = read_number_or_note(table, "void_ratio", "void_ratio_note", {0.1, 1.9}, csv);
  s.radial_stress = read_number_or_note(table, "confining_stress", "confining_stress_note", {1, 1e9}, csv);
  s.axial_stress = table.number("initial_axial_stress", {1, 1e9}, s.radial_stress);
  return s;
}

/// Strains of synthetic curves: denser at the start, where the curves are steep.
void make_strain(const TomlTable& table, LabTest& test) {
  const long rows = table.integer("rows", {3, 10000});
  const double end = table.number("axial_strain", {-1, 1});
  if (end == 0) table.fail("axial_strain", "a strain that is not 0", "0");
  for (long i = 1; i <= rows; ++i) test.strain.push_back(end * std::pow(double(i) / double(rows), 2));
  test.specimen.end_strain = end;
}

} // namespace

LabTest read_test(const TomlTable& table, const std::optional<TomlTable>& columns) {
  LabTest test;
  test.name = table.text("name");
  test.weight = table.number("weight", {0, 1e6}, 1);
  test.held_out = table.flag("held_out", false);
  const bool measured = table.has("file");
  const auto csv = measured ? std::optional<CsvTable>(table.path("file")) : std::nullopt;
  test.specimen = read_specimen(table, csv);
  if (!measured) {
    make_strain(table, test);
    for (const auto& name : table.texts("compare", measure_names()))
      test.curves.push_back({measure_named(name), std::vector<double>(test.strain.size())});
    return test;
  }
  const auto own = table.optional_table("columns");
  if (!own && !columns) table.fail("columns", "a table, here or at the top", "none");
  const auto& declared = own ? *own : *columns;
  const auto raw = read_curves(declared, *csv, test.specimen);
  Words given;
  for (std::size_t m = 0; m < measures.size(); ++m)
    if (raw.given[m]) given.emplace_back(measures[m].key);
  for (const auto& name : table.texts("compare", measure_names(), given)) {
    auto values = curve_of(raw, test.specimen, measure_named(name));
    if (values.empty())
      table.fail("compare", "curves that the columns hold or determine", fmt::format("\"{}\"", name));
    test.curves.push_back({measure_named(name), std::move(values)});
  }
  if (test.curves.empty()) table.fail("compare", "at least one curve", "none");
  for (std::size_t i = 1; i < raw.strain.size(); ++i)
    if (std::abs(raw.strain[i]) < std::abs(raw.strain[i - 1]) || raw.strain[i] * raw.strain.back() < 0)
      throw std::runtime_error(
          fmt::format("{}:{}: the axial strain turns back: monotonic tests only; check the column, and "
                      "remove unloading",
                      csv->file(), csv->line(i)));
  check_plausible(raw, test.specimen, test.curves, fmt::format("{}: test '{}'", table.where(), test.name));
  test.strain = raw.strain;
  test.specimen.end_strain = raw.strain.back();
  return test;
}

} // namespace calibration
