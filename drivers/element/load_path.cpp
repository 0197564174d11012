// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/load_path.hpp"
#include "drivers/element/presets.hpp"
#include "drivers/element/stage_conditions.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace drivers {
namespace {

/// Number of increments of a stage that is driven once.
long read_increments(const TomlTable& table, const Stage& stage) {
  const auto& driven = stage.conditions.front();
  const bool by_strain = driven.stress.isZero(0) && find_preset(stage.control);
  const auto key = by_strain ? only_one_of(table, {"increments", "strain_increment"}) : "increments";
  if (key == "increments") return table.integer(key, {1, 1e9});
  const double size = table.number(key, positive),
               count = std::ceil(std::abs(driven.value) / size * (1 - 1e-9));
  if (count > 1e9) table.fail(key, "at most 1e9 increments", fmt::format("{}", count));
  return std::max(1L, long(count));
}

void read_cyclic_drive(const TomlTable& table, Stage& stage) {
  auto& c = *stage.cycling;
  const bool strain = stage.conditions.front().stress.isZero(0);
  c.increment = table.number(strain ? "strain_increment" : "stress_increment", positive);
  const auto* preset = find_preset(stage.control);
  c.strain = find_linear_quantity(preset && preset->shears ? "shear_strain" : "axial_strain");
}

StopRule read_stop(const TomlTable& table, const Words& quantities) {
  const auto has = [&](const char* name) {
    return std::find(quantities.begin(), quantities.end(), name) != quantities.end();
  };
  StopRule rule;
  if (table.has("critical_state")) {
    rule.critical_tolerance = table.number("critical_state", {1e-9, 1});
    if (!has("critical_void_ratio") || !has("void_ratio"))
      table.fail("critical_state", "a void ratio, and SIMSAND or a table [critical_state]", "none");
    return rule;
  }
  auto names = quantities;
  for (const auto& name : linear_quantity_names())
    if (!has(name.c_str())) names.push_back(name);
  const auto bound = only_one_of(table, {"below", "above"});
  rule.quantity = table.text("quantity", names);
  rule.above = bound == "above";
  rule.bound = table.number(bound);
  return rule;
}

} // namespace

InitialState read_initial_state(const TomlTable& table) {
  InitialState out;
  if (only_one_of(table, {"mean_stress", "stress"}) == "stress")
    out.stress = read_six(table, "stress");
  else
    out.stress = table.number("mean_stress", not_negative) * weights(1, 1, 1);
  out.pore_pressure = table.number("pore_pressure", any_number, 0);
  if (table.has("state")) out.state = table.numbers("state");
  return out;
}

Stage read_stage(const TomlTable& table, int number, const Words& quantities) {
  Stage stage;
  stage.where = table.where();
  stage.name = table.text("name", {}, fmt::format("{}", number));
  stage.control = table.text("control", control_names());
  stage.duration = table.number("duration", positive, 1);
  if (stage.control == "envelope") {
    stage.envelope = read_envelope(table);
    return stage;
  }
  if (const auto cyclic = table.optional_table("cyclic")) stage.cycling = read_cycling(*cyclic);
  if (const auto replay = table.optional_table("replay")) {
    if (stage.cycling) table.fail("replay", "only one of cyclic, replay", "both");
    stage.measured = read_measured_path(*replay);
  }
  if (stage.control == motion_control) {
    if (stage.cycling || stage.measured)
      table.fail(stage.cycling ? "cyclic" : "replay", "a stage driven by stress and strain", "a motion");
    stage.motion = read_motion(table);
  } else
    read_conditions(table, stage);
  if (stage.held_total.isZero(0) && table.has("pore_pressure"))
    stage.pore_pressure = table.number("pore_pressure");
  if (stage.cycling)
    read_cyclic_drive(table, stage);
  else if (!stage.measured)
    stage.increments = read_increments(table, stage);
  stage.output_every = table.integer("output_every", {1, 1e9}, 1);
  for (const auto& stop : table.tables("stop")) stage.stops.push_back(read_stop(stop, quantities));
  return stage;
}

std::optional<Repetition> read_repetition(const TomlTable& table, std::size_t before) {
  if (table.text("control", control_names()) != "repeat") return std::nullopt;
  Repetition r;
  r.stages = table.integer("stages", {1, 1e6});
  r.times = table.integer("times", {1, 1e6});
  if (r.stages > long(before))
    table.fail("stages", fmt::format("at most {}, the stages before", before), fmt::format("{}", r.stages));
  return r;
}

MixedControl control_from(const Stage& stage, const Vector6& stress, const Vector6& strain) {
  MixedControl out;
  for (int i = 0; i < 6; ++i) {
    const auto& c = stage.conditions[i];
    out.stress.row(i) = c.stress;
    out.strain.row(i) = c.strain;
    out.at_start[i] = c.at(stress, strain);
    out.change[i] = c.is_final ? c.value - out.at_start[i] : c.value;
  }
  return out;
}

double pore_pressure_change(const Stage& stage, const Vector6& effective_change) {
  const double weight = stage.held_total.head<3>().sum();
  return weight == 0 ? 0 : -stage.held_total.dot(effective_change) / weight;
}

double pore_pressure_ratio(const Stage& stage, const Vector6& start, double change) {
  const double held = stage.held_total.dot(start);
  return held > 0 ? change * stage.held_total.head<3>().sum() / held : 0;
}

Words control_names() {
  Words names;
  for (const auto& preset : presets()) names.push_back(preset.name);
  for (const auto& name : general_control_names()) names.push_back(name);
  for (const char* name : {motion_control, "envelope", "repeat"}) names.emplace_back(name);
  return names;
}

} // namespace drivers
