// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/load_path.hpp"
#include <Eigen/LU>
#include <cmath>
#include <fmt/format.h>

namespace drivers {
namespace {

Vector6 row(double a11, double a22, double a33, double a12 = 0, double a23 = 0, double a31 = 0) {
  return (Vector6() << a11, a22, a33, a12, a23, a31).finished();
}

const Vector6 none = Vector6::Zero(), trace = row(1, 1, 1);

Condition held_stress(const Vector6& weights) {
  return {weights, none, 0, false};
}
Condition held_strain(const Vector6& weights) {
  return {none, weights, 0, false};
}

/// What may drive a stage: a combination of strain by its change, or one of stress by its final value.
struct Drive {
  const char* key;
  Condition condition; ///< value 0
};

const std::vector<Drive>& drives() {
  static const std::vector<Drive> table{
      {"axial_strain", {none, Vector6::Unit(0), 0, false}},
      {"volumetric_strain", {none, trace, 0, false}},
      {"shear_strain", {none, 2 * Vector6::Unit(3), 0, false}}, // engineering, 1-2
      {"axial_stress", {Vector6::Unit(0), none, 0, true}},
      {"mean_stress", {trace / 3, none, 0, true}},
      {"shear_stress", {Vector6::Unit(3), none, 0, true}},
  };
  return table;
}

/// A laboratory test: what may drive it, what else holds on the direct components and 1-2, and the
/// total stress that is held if it is undrained. Shear strains that are not mentioned are held.
struct Preset {
  const char* name;
  Words drives;
  std::vector<Condition> held;
  Vector6 held_total;
  bool shears = false; ///< 1-2 is driven
};

const std::vector<Preset>& presets() {
  const auto s11 = held_stress(row(1, 0, 0)), s22 = held_stress(row(0, 1, 0)),
             s33 = held_stress(row(0, 0, 1)), p = held_stress(trace), s11_is_s22 = held_stress(row(1, -1, 0)),
             s22_is_s33 = held_stress(row(0, 1, -1));
  const auto e11 = held_strain(row(1, 0, 0)), e22 = held_strain(row(0, 1, 0)),
             e33 = held_strain(row(0, 0, 1)), volume = held_strain(trace);
  const Vector6 cell = row(0, 1, 0), vertical = row(1, 0, 0);
  const Words axial{"axial_strain", "axial_stress"}, shear{"shear_strain", "shear_stress"};
  static const std::vector<Preset> table{
      {"isotropic", {"mean_stress", "volumetric_strain"}, {s11_is_s22, s22_is_s33}, none},
      {"oedometric", axial, {e22, e33}, none},
      {"triaxial-drained", axial, {s22, s33}, none},
      {"triaxial-undrained", axial, {volume, s22_is_s33}, cell},
      {"triaxial-constant-p", axial, {p, s22_is_s33}, none},
      {"plane-strain-drained", axial, {s22, e33}, none},
      {"plane-strain-undrained", axial, {volume, e33}, cell},
      {"simple-shear-drained", shear, {s11, e22, e33}, none, true},
      {"simple-shear-undrained", shear, {e11, e22, e33}, vertical, true},
      // Their condition of a constant intermediate ratio is added when it is read.
      {"true-triaxial-drained", axial, {s33}, none},
      {"true-triaxial-constant-p", axial, {p}, none},
  };
  return table;
}

/// The one of `keys` that the table has.
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

Condition read_drive(const TomlTable& table, const Words& keys) {
  const auto key = only_one_of(table, keys);
  for (const auto& drive : drives())
    if (drive.key == key) {
      auto condition = drive.condition;
      condition.value = table.number(key);
      return condition;
    }
  table.fail(key, "a key that drives a stage", "another");
}

void read_preset(const TomlTable& table, const Preset& preset, Stage& stage) {
  std::vector<Condition> rows{read_drive(table, preset.drives)};
  rows.insert(rows.end(), preset.held.begin(), preset.held.end());
  if (stage.control.starts_with("true-triaxial")) {
    const double b = table.number("intermediate_ratio", {0, 1}); // (s22 - s33) / (s11 - s33)
    rows.push_back(held_stress(row(-b, 1, b - 1)));
  }
  for (int c = preset.shears ? 4 : 3; c < 6; ++c) rows.push_back(held_strain(Vector6::Unit(c)));
  std::copy(rows.begin(), rows.end(), stage.conditions.begin());
  stage.held_total = preset.held_total;
}

Vector6 read_six(const TomlTable& table, std::string_view key,
                 std::optional<std::vector<double>> fallback = {}) {
  return Eigen::Map<const Vector6>(table.numbers(key, 6, any_number, std::move(fallback)).data());
}

void read_mixed(const TomlTable& table, Stage& stage) {
  const std::vector<double> zeros(6, 0.0);
  const auto rows = table.tables("condition", 6);
  if (rows.size() != 6)
    table.fail("condition", "6 tables [[stage.condition]]", fmt::format("{}", rows.size()));
  Eigen::Matrix<double, 6, 12> all;
  for (int i = 0; i < 6; ++i) {
    auto& c = stage.conditions[i];
    c.stress = read_six(rows[i], "stress", zeros);
    c.strain = read_six(rows[i], "strain", zeros);
    c.is_final = rows[i].has("final");
    if (c.is_final && rows[i].has("change")) only_one_of(rows[i], {"change", "final"});
    c.value = c.is_final ? rows[i].number("final") : rows[i].number("change", any_number, 0);
    const double scale = std::max(c.stress.cwiseAbs().maxCoeff(), c.strain.cwiseAbs().maxCoeff());
    all.row(i) << c.stress.transpose(), c.strain.transpose();
    if (scale > 0) all.row(i) /= scale;
  }
  if (all.fullPivLu().rank() < 6) table.fail("condition", "six independent conditions", "dependent ones");
  stage.held_total = read_six(table, "held_total_stress", zeros);
  if (!stage.held_total.isZero(0) && stage.held_total.head<3>().sum() == 0)
    table.fail("held_total_stress", "weights of 11, 22, 33 with a sum", "a sum of 0");
}

long read_increments(const TomlTable& table, const Stage& stage) {
  const auto& driven = stage.conditions.front();
  const bool by_strain = driven.stress.isZero(0) && stage.control != "mixed" && stage.control != "strain";
  const auto key = by_strain ? only_one_of(table, {"increments", "strain_increment"}) : "increments";
  if (key == "increments") return table.integer(key, {1, 1e9});
  const double size = table.number(key, positive),
               count = std::ceil(std::abs(driven.value) / size * (1 - 1e-9));
  if (count > 1e9) table.fail(key, "at most 1e9 increments", fmt::format("{}", count));
  return std::max(1L, long(count));
}

} // namespace

InitialState read_initial_state(const TomlTable& table) {
  InitialState out;
  if (only_one_of(table, {"mean_stress", "stress"}) == "stress")
    out.stress = read_six(table, "stress");
  else
    out.stress = table.number("mean_stress", not_negative) * trace;
  out.pore_pressure = table.number("pore_pressure", any_number, 0);
  if (table.has("state")) out.state = table.numbers("state");
  return out;
}

Stage read_stage(const TomlTable& table, int number, const Words& quantities) {
  Stage stage;
  stage.where = table.where();
  stage.name = table.text("name", {}, fmt::format("{}", number));
  stage.control = table.text("control", control_names());
  const Words six{"strain", "stress"};
  if (stage.control == "mixed")
    read_mixed(table, stage);
  else if (stage.control == "strain" || stage.control == "stress") {
    const bool strain = stage.control == "strain";
    const auto values = read_six(table, stage.control);
    for (int c = 0; c < 6; ++c)
      stage.conditions[c] = {strain ? none : Vector6::Unit(c), strain ? Vector6::Unit(c) : none, values[c],
                             !strain};
  } else
    for (const auto& preset : presets())
      if (stage.control == preset.name) read_preset(table, preset, stage);
  stage.increments = read_increments(table, stage);
  stage.output_every = table.integer("output_every", {1, 1e9}, 1);
  stage.duration = table.number("duration", positive, 1);
  for (const auto& stop : table.tables("stop")) {
    const auto bound = only_one_of(stop, {"below", "above"});
    stage.stops.push_back({stop.text("quantity", quantities), bound == "above", stop.number(bound)});
  }
  return stage;
}

MixedControl control_from(const Stage& stage, const Vector6& stress, const Vector6& strain) {
  MixedControl out;
  for (int i = 0; i < 6; ++i) {
    const auto& c = stage.conditions[i];
    out.stress.row(i) = c.stress;
    out.strain.row(i) = c.strain;
    out.at_start[i] = c.stress.dot(stress) + c.strain.dot(strain);
    out.change[i] = c.is_final ? c.value - out.at_start[i] : c.value;
  }
  return out;
}

double pore_pressure_change(const Stage& stage, const Vector6& effective_change) {
  const double weight = stage.held_total.head<3>().sum();
  return weight == 0 ? 0 : -stage.held_total.dot(effective_change) / weight;
}

Words control_names() {
  Words names;
  for (const auto& preset : presets()) names.emplace_back(preset.name);
  for (const char* general : {"strain", "stress", "mixed"}) names.emplace_back(general);
  return names;
}

} // namespace drivers
