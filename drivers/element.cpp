// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element.hpp"
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <stdexcept>

namespace drivers {
namespace {

constexpr const char* component_names[] = {"11", "22", "33", "12", "23", "31"};

Words quantity_names(const LoadedMaterial& material) {
  Words names;
  for (const auto& q : quantities(material)) names.push_back(q.name);
  return names;
}

NewtonOptions read_newton(const TomlTable& table) {
  NewtonOptions n;
  n.tolerance = table.number("tolerance", {1e-14, 1e-2}, n.tolerance);
  n.max_iterations = int(table.integer("max_iterations", {1, 1000}, n.max_iterations));
  n.max_cuts = int(table.integer("max_cuts", {0, 40}, n.max_cuts));
  return n;
}

std::string why(const Stage& stage, const StepReport& report) {
  if (report.refused) return "the material reports a failed update";
  if (!report.finite) return "the material returned a stress that is not finite";
  return fmt::format("condition {} of 6 misses by {:.3g} {}", report.restriction + 1, report.residual,
                     stage.conditions[report.restriction].unit());
}

void write_line(std::FILE* file, const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file) != line.size())
    throw std::runtime_error("cannot write the output");
}

} // namespace

ElementCase read_element_case(const TomlTable& document) {
  ElementCase out;
  out.title = document.text("title", {}, "");
  const auto initial = document.table("initial");
  const auto void_ratio =
      initial.has("void_ratio") ? std::optional(initial.number("void_ratio", positive)) : std::nullopt;
  out.material = read_material(document.table("material"), void_ratio);
  const auto start = read_initial_state(initial);
  const std::size_t states = out.material.state_names.size();
  if (!start.state.empty() && start.state.size() != states)
    initial.fail("state", fmt::format("{} state variables", states), fmt::format("{}", start.state.size()));
  out.initial.stress = start.stress;
  out.initial.state = start.state.empty() ? out.material.initial_state : start.state;
  out.initial.initial_density = out.material.bulk_density;
  out.pore_pressure = start.pore_pressure;
  const auto names = quantity_names(out.material);
  for (const auto& stage : document.tables("stage", 1))
    out.stages.push_back(read_stage(stage, int(out.stages.size()) + 1, names));
  out.newton = read_newton(document.table_or_empty("newton"));
  document.finish();
  out.resolved = document.resolved();
  return out;
}

std::vector<Quantity> quantities(const LoadedMaterial& material) {
  std::vector<Quantity> q;
  q.push_back({"time", "s", [](const ElementRow& r) { return r.point.time; }});
  for (int c = 0; c < 6; ++c)
    q.push_back({std::string("strain_") + component_names[c], "",
                 [c](const ElementRow& r) { return r.point.strain[c]; }});
  for (int c = 0; c < 6; ++c)
    q.push_back({std::string("stress_") + component_names[c], "Pa",
                 [c](const ElementRow& r) { return r.point.stress[c]; }});
  q.push_back({"p", "Pa", [](const ElementRow& r) { return mean_stress(r.point.stress); }});
  q.push_back({"q", "Pa", [](const ElementRow& r) { return deviatoric_stress(r.point.stress); }});
  q.push_back({"lode_angle", "deg", [](const ElementRow& r) { return lode_angle(r.point.stress); }});
  q.push_back(
      {"volumetric_strain", "", [](const ElementRow& r) { return volumetric_strain(r.point.strain); }});
  q.push_back(
      {"deviatoric_strain", "", [](const ElementRow& r) { return deviatoric_strain(r.point.strain); }});
  if (const auto e0 = material.void_ratio) // d e = -(1 + e) d eps_v, from the strain alone
    q.push_back({"void_ratio", "", [e0](const ElementRow& r) {
                   return (1 + *e0) * std::exp(-volumetric_strain(r.point.strain)) - 1;
                 }});
  q.push_back({"pore_pressure", "Pa", [](const ElementRow& r) { return r.pore_pressure; }});
  for (std::size_t s = 0; s < material.state_names.size(); ++s)
    q.push_back(
        {"state_" + material.state_names[s], "", [s](const ElementRow& r) { return r.point.state[s]; }});
  q.push_back({"internal_energy", "J_per_kg", [](const ElementRow& r) { return r.point.internal_energy; }});
  q.push_back({"inelastic_energy", "J_per_kg", [](const ElementRow& r) { return r.point.inelastic_energy; }});
  q.push_back({"iterations", "", [](const ElementRow& r) { return r.effort.iterations; }});
  q.push_back({"cuts", "", [](const ElementRow& r) { return r.effort.cuts; }});
  return q;
}

ElementRow run_element_case(const ElementCase& element, const RowSink& sink) {
  MaterialCaller material(element.material.material, element.material.failure_state);
  const auto columns = quantities(element.material);
  ElementRow row{0, 0, element.initial, element.pore_pressure, {}};
  sink(row);
  for (const auto& stage : element.stages) {
    const ElementRow start = row;
    const auto control = control_from(stage, start.point.stress, start.point.strain);
    Matrix6 stiffness = material.elastic_stiffness(start.point);
    const auto scale = scale_of(start.point.stress, stiffness);
    const auto stopped = [&] {
      for (const auto& rule : stage.stops)
        for (const auto& column : columns)
          if (column.name == rule.quantity && rule.met(column.value(row))) return true;
      return false;
    };
    ++row.stage;
    bool stop = false;
    for (row.step = 1; row.step <= stage.increments && !stop; ++row.step) {
      const double from = double(row.step - 1) / stage.increments, to = double(row.step) / stage.increments;
      row.effort =
          advance(material, control, from, to, stage.duration, scale, element.newton, row.point, stiffness);
      row.pore_pressure =
          start.pore_pressure + pore_pressure_change(stage, row.point.stress - start.point.stress);
      if (!row.effort.converged) {
        sink(row);
        throw std::runtime_error(
            fmt::format("{}: stage {} '{}', step {} of {}: {}; {} cuts and {} iterations", stage.where,
                        row.stage, stage.name, row.step, stage.increments, why(stage, row.effort),
                        row.effort.cuts, row.effort.iterations));
      }
      stop = stopped();
      if (stop || row.step == stage.increments || row.step % stage.output_every == 0) sink(row);
    }
    --row.step;
  }
  return row;
}

int run_element(const ElementOptions& options) {
  try {
    const auto element = read_element_case(read_toml(options.path_file));
    if (!options.resolved.empty()) {
      const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(options.resolved.c_str(), "w"),
                                                                 std::fclose);
      if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", options.resolved));
      write_line(file.get(), element.resolved);
    }
    const bool to_standard = options.output.empty() || options.output == "-";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        to_standard ? stdout : std::fopen(options.output.c_str(), "w"),
        to_standard ? [](std::FILE* f) { return std::fflush(f); } : std::fclose);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", options.output));
    const auto columns = quantities(element.material);
    std::string line = "stage,step";
    for (const auto& c : columns) line += ',' + c.name + (c.unit.empty() ? "" : '_' + c.unit);
    write_line(file.get(), line + '\n');
    run_element_case(element, [&](const ElementRow& row) {
      line = fmt::format("{},{}", row.stage, row.step);
      for (const auto& c : columns) line += fmt::format(",{:.12g}", c.value(row));
      write_line(file.get(), line + '\n');
    });
  } catch (const std::exception& error) {
    fmt::print(stderr, "simsand element: {}\n", error.what());
    return 1;
  }
  return 0;
}

} // namespace drivers
