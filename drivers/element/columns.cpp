// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/columns.hpp"
#include "drivers/element/condition.hpp"
#include <cmath>

namespace drivers {
namespace {

using Row = const ElementRow&;

void add_components(std::vector<OutputColumn>& q) {
  for (const bool strain : {true, false})
    for (int c = 0; c < 6; ++c) {
      const auto& component = linear_quantities()[strain ? c : 6 + c];
      q.push_back({component.name, strain ? "" : "Pa",
                   [=](Row r) { return strain ? r.point.strain[c] : stress_in_base_axes(r.point)[c]; }});
    }
}

void add_invariants(std::vector<OutputColumn>& q) {
  q.push_back({"p", "Pa", [](Row r) { return mean_stress(r.point.stress); }});
  q.push_back({"q", "Pa", [](Row r) { return deviatoric_stress(r.point.stress); }});
  const Vector6 axial = find_linear_quantity("deviator")->weights;
  q.push_back({"deviator", "Pa", [axial](Row r) { return axial.dot(r.point.stress); }});
  q.push_back({"lode_angle", "deg", [](Row r) { return lode_angle(r.point.stress); }});
  q.push_back({"volumetric_strain", "", [](Row r) { return volumetric_strain(r.point.strain); }});
  q.push_back({"deviatoric_strain", "", [](Row r) { return deviatoric_strain(r.point.strain); }});
}

void add_void_ratios(std::vector<OutputColumn>& q, std::optional<double> initial,
                     const std::optional<CriticalState>& critical) {
  if (initial)
    q.push_back({"void_ratio", "", [e = *initial](Row r) { return void_ratio_after(e, r.point.strain); }});
  if (!critical) return;
  q.push_back({"critical_void_ratio", "",
               [c = *critical](Row r) { return c.void_ratio(mean_stress(r.point.stress)); }});
  q.push_back({"critical_stress_ratio", "",
               [c = *critical](Row r) { return c.stress_ratio(lode_angle(r.point.stress)); }});
}

} // namespace

double void_ratio_after(double initial, const Vector6& strain) {
  return (1 + initial) * std::exp(-volumetric_strain(strain)) - 1;
}

std::vector<OutputColumn> output_columns(const LoadedMaterial& material,
                                         const std::optional<CriticalState>& critical) {
  std::vector<OutputColumn> q;
  q.push_back({"time", "s", [](Row r) { return r.point.time; }});
  add_components(q);
  add_invariants(q);
  add_void_ratios(q, material.void_ratio, critical);
  q.push_back({"pore_pressure", "Pa", [](Row r) { return r.pore_pressure; }});
  q.push_back({"pore_pressure_ratio", "", [](Row r) { return r.pore_pressure_ratio; }});
  q.push_back(
      {"total_mean_stress", "Pa", [](Row r) { return mean_stress(r.point.stress) + r.pore_pressure; }});
  q.push_back({"cycles", "", [](Row r) { return r.cycles; }});
  q.push_back({"double_amplitude", "", [](Row r) { return r.double_amplitude; }});
  for (std::size_t s = 0; s < material.state_names.size(); ++s)
    q.push_back({"state_" + material.state_names[s], "", [s](Row r) { return r.point.state[s]; }});
  q.push_back({"internal_energy", "J_per_kg", [](Row r) { return r.point.internal_energy; }});
  q.push_back({"inelastic_energy", "J_per_kg", [](Row r) { return r.point.inelastic_energy; }});
  q.push_back({"iterations", "", [](Row r) { return r.effort.iterations; }});
  q.push_back({"cuts", "", [](Row r) { return r.effort.cuts; }});
  return q;
}

} // namespace drivers
