// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/cases.hpp"
#include "tests/charts/increments.hpp"
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace charts {
namespace {

[[noreturn]] void refuse(const std::string& file, int line, const std::string& expected) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file, line, expected));
}

/// The numbers of a row, which must be as many as the columns.
std::vector<double> numbers(const std::string& text, char separator) {
  std::vector<double> out;
  std::stringstream row(text);
  for (std::string word; std::getline(row, word, separator);) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty()) continue;
    if (*end) return {};
    out.push_back(value);
  }
  return out;
}

/// Cases are told apart by the size of their increment.
std::string size_of(double increment) {
  return increment < 1e-5   ? "collapse, strain below 1e-5"
         : increment < 1e-4 ? "collapse, strain 1e-5 to 1e-4"
                            : "collapse, strain above 1e-4";
}

Case case_of(const Material& m, const std::vector<double>& row) {
  Case c{-1, "", "sampled", 0, 0, {}, {Tensor{}}};
  for (int i = 0; i < 4; ++i) {
    c.strain[0][i] = row[i];
    c.start.stress[i] = row[4 + i];
  }
  c.start.void_ratio = row[8];
  c.start.plastic_strain = row[9];
  c.start.separation_strain = row[10];
  c.start = simsand::update(m, c.start, Tensor{}).state;
  c.pressure = mean(c.start.stress);
  c.increment = norm(c.strain[0]);
  c.path = size_of(c.increment);
  return c;
}

} // namespace

std::vector<Case> sampled_cases(const std::string& file, std::vector<double>& props) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  std::string text;
  std::getline(in, text);
  constexpr std::string_view title = "# properties";
  if (!text.starts_with(title)) refuse(file, 1, "expected '# properties' and the numbers of PROPS");
  props = numbers(text.substr(title.size()), ' ');
  simsand::Parameters<double> parameters;
  if (const auto error = simsand::read_props(props.data(), int(props.size()), parameters); error.entry)
    refuse(file, 1, fmt::format("property {} is {}", error.entry, error.reason));
  const Material m(parameters);
  std::getline(in, text);
  if (text != states_header) refuse(file, 2, fmt::format("expected the columns {}", states_header));
  std::vector<Case> cases;
  for (int line = 3; std::getline(in, text); ++line) {
    const auto row = numbers(text, ',');
    if (row.size() != 11) refuse(file, line, "expected 11 numbers");
    if (!(row[8] > 0)) refuse(file, line, "expected a positive void ratio");
    cases.push_back(case_of(m, row));
  }
  if (cases.empty()) throw std::runtime_error(file + ": holds no updates");
  return cases;
}

} // namespace charts
