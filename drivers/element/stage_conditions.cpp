// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/stage_conditions.hpp"
#include "drivers/element/presets.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <fmt/format.h>

namespace drivers {
namespace {

const Vector6 none = Vector6::Zero();

/// Controls whose conditions stand in the path file, and how many of them; the others follow from symmetry.
struct General {
  const char* name;
  std::size_t conditions;
};
constexpr General general_controls[] = {{"axisymmetric", 2}, {"principal", 3}, {"mixed", 6}};

/// A condition by its weights, `stress` and `strain`, and by coefficients of named quantities.
Condition read_condition(const TomlTable& table, bool driven_elsewhere) {
  const std::vector<double> zeros(6, 0.0);
  Condition c;
  c.stress = read_six(table, "stress", zeros);
  c.strain = read_six(table, "strain", zeros);
  for (const auto& q : linear_quantities())
    if (table.has(q.name)) (q.is_strain ? c.strain : c.stress) += table.number(q.name) * q.weights;
  if (!driven_elsewhere) {
    c.is_final = table.has("final");
    if (c.is_final && table.has("change")) only_one_of(table, {"change", "final"});
    c.value = c.is_final ? table.number("final") : table.number("change", any_number, 0);
  }
  table.finish(); // here, so that a misspelt quantity is named before its condition is found to be incomplete
  return c;
}

/// Whether the six conditions are linearly independent; each is divided by its largest weight.
bool independent(const std::array<Condition, 6>& conditions) {
  Eigen::Matrix<double, 6, 12> all;
  for (int i = 0; i < 6; ++i) {
    const auto& c = conditions[i];
    all.row(i) << c.stress.transpose(), c.strain.transpose();
    const double scale = all.row(i).cwiseAbs().maxCoeff();
    if (scale > 0) all.row(i) /= scale;
  }
  return all.fullPivLu().rank() == 6;
}

/// The condition that drives a preset: a column of a replay, a quantity that cycles, or one with a given value.
std::vector<Condition> read_drives(const TomlTable& table, const Preset& preset, const Stage& stage) {
  if (stage.measured) {
    if (stage.measured->driven.size() != 1)
      table.fail("replay", fmt::format("one column that drives '{}'", preset.name),
                 fmt::format("{}", stage.measured->driven.size()));
    return {stage.measured->driven.front()->condition()};
  }
  if (stage.cycling) {
    const auto strain = std::find_if(preset.drives.begin(), preset.drives.end(),
                                     [](const auto& name) { return find_linear_quantity(name)->is_strain; });
    return {find_linear_quantity(table.table("cyclic").text("drive", preset.drives, *strain))->condition()};
  }
  const auto key = only_one_of(table, preset.drives);
  return {find_linear_quantity(key)->condition(table.number(key))};
}

/// The conditions that a preset leaves to the path file.
std::vector<Condition> read_ratios(const TomlTable& table, const Preset& preset) {
  if (preset.ratio.empty()) return {};
  if (preset.ratio == "intermediate_ratio") { // (s22 - s33) / (s11 - s33)
    const double b = table.number(preset.ratio, {0, 1});
    return {{weights(-b, 1, b - 1), none, 0, false}};
  }
  const auto r = table.numbers(preset.ratio, 2); // of 22 and 33 to 11
  const Vector6 second = weights(-r[0], 1, 0), third = weights(-r[1], 0, 1);
  if (preset.ratio == "stress_ratios") return {{second, none, 0, false}, {third, none, 0, false}};
  return {{none, second, 0, false}, {none, third, 0, false}};
}

std::vector<Condition> read_preset(const TomlTable& table, const Preset& preset, Stage& stage) {
  auto rows = read_drives(table, preset, stage);
  rows.insert(rows.end(), preset.held.begin(), preset.held.end());
  for (const auto& ratio : read_ratios(table, preset)) rows.push_back(ratio);
  for (int c = preset.shears ? 4 : 3; c < 6; ++c) rows.push_back({none, Vector6::Unit(c), 0, false});
  stage.held_total = preset.held_total;
  return rows;
}

std::vector<Condition> read_general(const TomlTable& table, const General& general, Stage& stage) {
  std::vector<Condition> rows;
  if (stage.measured)
    for (const auto* quantity : stage.measured->driven) rows.push_back(quantity->condition());
  const std::size_t driven = rows.size();
  const auto tables = table.tables("condition");
  if (driven + tables.size() != general.conditions)
    table.fail("condition", fmt::format("{} tables [[stage.condition]]", general.conditions - driven),
               fmt::format("{}", tables.size()));
  for (const auto& t : tables) rows.push_back(read_condition(t, stage.cycling || stage.measured));
  if (general.conditions == 2) rows.push_back({weights(0, 1, -1), none, 0, false});
  if (general.conditions < 6)
    for (int c = 3; c < 6; ++c) rows.push_back({none, Vector6::Unit(c), 0, false});
  stage.held_total = read_six(table, "held_total_stress", std::vector<double>(6, 0.0));
  if (!stage.held_total.isZero(0) && stage.held_total.head<3>().sum() == 0)
    table.fail("held_total_stress", "weights of 11, 22, 33 with a sum", "a sum of 0");
  return rows;
}

std::vector<Condition> read_components(const TomlTable& table, const Stage& stage) {
  if (stage.cycling || stage.measured)
    table.fail("control", "another control with 'cyclic' or 'replay'", quoted_text(stage.control));
  const bool strain = stage.control == "strain";
  const auto values = read_six(table, stage.control);
  std::vector<Condition> rows;
  for (int c = 0; c < 6; ++c)
    rows.push_back({strain ? none : Vector6::Unit(c), strain ? Vector6::Unit(c) : none, values[c], !strain});
  return rows;
}

} // namespace

void read_conditions(const TomlTable& table, Stage& stage) {
  std::vector<Condition> rows;
  const auto* general = std::find_if(std::begin(general_controls), std::end(general_controls),
                                     [&](const auto& g) { return g.name == stage.control; });
  if (const auto* preset = find_preset(stage.control))
    rows = read_preset(table, *preset, stage);
  else if (general != std::end(general_controls))
    rows = read_general(table, *general, stage);
  else
    rows = read_components(table, stage);
  std::copy(rows.begin(), rows.end(), stage.conditions.begin());
  if (!independent(stage.conditions)) table.fail("condition", "six independent conditions", "dependent ones");
}

Words general_control_names() {
  Words names{"strain", "stress"};
  for (const auto& general : general_controls) names.emplace_back(general.name);
  return names;
}

std::string only_one_of(const TomlTable& table, const Words& keys) {
  std::string found;
  for (const auto& key : keys)
    if (table.has(key)) {
      if (!found.empty())
        table.fail(key, fmt::format("only one of {}", joined(keys)), "'" + found + "' as well");
      found = key;
    }
  if (found.empty()) table.fail(keys.front(), fmt::format("one of {}", joined(keys)), "none of them");
  return found;
}

Vector6 read_six(const TomlTable& table, std::string_view key, std::optional<std::vector<double>> fallback) {
  return Eigen::Map<const Vector6>(table.numbers(key, 6, any_number, std::move(fallback)).data());
}

} // namespace drivers
