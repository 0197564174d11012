// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/element_chart.hpp"
#include "drivers/element/pictures.hpp"
#include "drivers/files/csv_write.hpp"
#include <filesystem>
#include <fmt/format.h>

namespace charts {
namespace {

void write_rows(const std::vector<Row>& rows, const std::filesystem::path& file) {
  using drivers::Rounded;
  drivers::CsvWriter table(element_header);
  for (const auto& r : rows)
    table.row(r.method, r.setting, Rounded{r.increment}, r.group, r.member, r.cases, r.updates,
              Rounded{r.error_median, 4}, Rounded{r.error_95, 4}, Rounded{r.error_largest, 4}, r.over_a_tenth,
              r.not_finite, r.not_converged, r.drifted, Rounded{r.nanoseconds, 4});
  table.write(file);
}

void print_rows(const std::vector<Row>& rows) {
  const Row& first = rows.front();
  fmt::print("\n{}, {} cases, {} updates\n",
             first.increment > 0 ? fmt::format("strain increment {:g}", first.increment)
                                 : "updates of the collapse",
             first.cases, first.updates);
  fmt::print("{:<24} {:<17} {:>9} {:>9} {:>9} {:>6} {:>6} {:>6} {:>6} {:>9}\n", "", "", "median", "95 %",
             "largest", ">0.1", "nan", "conv", "drift", "ns");
  for (const auto& r : rows)
    if (r.group == "all")
      fmt::print("{:<24} {:<17} {:9.1e} {:9.1e} {:9.1e} {:6} {:6} {:6} {:6} {:9.0f}\n", r.method, r.setting,
                 r.error_median, r.error_95, r.error_largest, r.over_a_tenth, r.not_finite, r.not_converged,
                 r.drifted, r.nanoseconds);
}

void draw(const std::filesystem::path& folder) {
  drivers::Words tables{(folder / "element.csv").string()};
  if (const auto increments = folder / "increments.csv"; std::filesystem::exists(increments))
    tables.push_back(increments.string());
  drivers::run_script("charts/figures.py", tables, folder.string());
}

} // namespace

void chart_element(const ElementOptions& options) {
  const auto methods = all_methods();
  std::vector<std::vector<double>> props;
  for (const auto& sand : sands) props.push_back(properties(sand));
  std::vector<Row> rows;
  const auto compare_cases = [&](const std::vector<Case>& cases,
                                 const std::vector<std::vector<double>>& materials) {
    const auto part = compare(cases, materials, methods, options.repetitions);
    print_rows(part);
    std::fflush(stdout);
    rows.insert(rows.end(), part.begin(), part.end());
  };
  if (!options.states.empty()) {
    std::vector<double> sampled_props;
    const auto cases = sampled_cases(options.states, sampled_props);
    compare_cases(cases, {sampled_props});
  }
  for (const double increment : options.increments)
    compare_cases(laboratory_cases(options.choice, increment), props);
  const std::filesystem::path folder = options.folder;
  std::filesystem::create_directories(folder);
  write_rows(rows, folder / "element.csv");
  fmt::print("\n{}\n", (folder / "element.csv").string());
  std::fflush(stdout); // before what the script says
  if (options.figures) draw(folder);
}

} // namespace charts
