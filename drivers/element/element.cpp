// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/element.hpp"
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

NewtonOptions read_newton(const TomlTable& table) {
  NewtonOptions n;
  n.tolerance = table.number("tolerance", {1e-14, 1e-2}, n.tolerance);
  n.max_iterations = int(table.integer("max_iterations", {1, 1000}, n.max_iterations));
  n.max_cuts = int(table.integer("max_cuts", {0, 40}, n.max_cuts));
  return n;
}

std::vector<Stage> read_stages(const TomlTable& document, const ElementCase& element) {
  Words names;
  for (const auto& q : output_columns(element.material, element.critical)) names.push_back(q.name);
  std::vector<Stage> stages;
  for (const auto& table : document.tables("stage", 1)) {
    const auto again = read_repetition(table, stages.size());
    if (!again) stages.push_back(read_stage(table, int(stages.size()) + 1, names));
    // Conditions are in corotational axes, columns in base axes: after a rotation the two would differ.
    if (stages.front().motion.has_value() != stages.back().motion.has_value())
      table.fail("control", fmt::format("either all stages or none by \"{}\"", motion_control),
                 "'" + stages.back().control + "'");
    const std::size_t count = again ? std::size_t(again->stages * again->times) : 0;
    for (std::size_t i = 0; i < count; ++i) {
      Stage copy = stages[stages.size() - std::size_t(again->stages)];
      stages.push_back(std::move(copy));
    }
  }
  return stages;
}

} // namespace

ElementCase read_element_case(const TomlTable& document) {
  ElementCase out;
  out.title = document.text("title", {}, "");
  const auto initial = document.table("initial");
  const auto void_ratio =
      initial.has("void_ratio") ? std::optional(initial.number("void_ratio", positive)) : std::nullopt;
  out.material = read_material(document.table("material"), void_ratio);
  out.critical = read_critical_state(document, out.material);
  const auto start = read_initial_state(initial);
  const std::size_t states = out.material.state_names.size();
  if (!start.state.empty() && start.state.size() != states)
    initial.fail("state", fmt::format("{} state variables", states), fmt::format("{}", start.state.size()));
  out.initial.stress = start.stress;
  out.initial.state = start.state.empty() ? out.material.initial_state : start.state;
  out.initial.initial_density = out.material.bulk_density;
  out.pore_pressure = start.pore_pressure;
  out.stages = read_stages(document, out);
  out.newton = read_newton(document.table_or_empty("newton"));
  document.finish();
  out.resolved = document.resolved();
  return out;
}

ElementRow run_element_case(const ElementCase& element, const RowSink& sink, const EnvelopeSink& envelopes,
                            const std::string& failed_point) {
  MaterialCaller material(element.material.material, element.material.failure_state);
  const auto columns = output_columns(element.material, element.critical);
  const StageSetting setting{material,       columns, element.critical, element.material.void_ratio,
                             element.newton, sink,    failed_point};
  ElementRow row;
  row.point = element.initial;
  row.pore_pressure = element.pore_pressure;
  sink(row);
  for (const auto& stage : element.stages) {
    if (!stage.envelope) {
      run_stage(setting, stage, row);
      continue;
    }
    ++row.stage;
    try {
      probe(material, row.point, *stage.envelope, stage.duration, row.stage, envelopes, failed_point);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(
          fmt::format("{}: stage {} '{}', {}", stage.where, row.stage, stage.name, error.what()));
    }
  }
  return row;
}

} // namespace drivers
