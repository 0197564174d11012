// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/critical_state.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <cmath>

namespace drivers {
namespace {

CriticalState of_simsand(const std::vector<double>& properties) {
  const auto value = [&](const char* key) { return properties.at(simsand::parameter_index(key)); };
  const double p_at = value("p_at"), p_min = value("p_min");
  return {value("phi"),  value("e_ref"), value("lambda"),
          value("zeta"), p_at,           p_min > 0 ? p_min : 1e-5 * p_at};
}

} // namespace

double CriticalState::void_ratio(double p) const {
  constexpr double smallest = 0.01; // the floor of e_c in the material
  return std::max(e_ref - lambda * std::pow(std::max(p, p_min) / p_at, zeta), smallest);
}

double CriticalState::stress_ratio(double lode_angle) const {
  const double sine = std::sin(friction_angle * M_PI / 180), c = (3 - sine) / (3 + sine), c4 = std::pow(c, 4),
               s = std::sin(3 * lode_angle * M_PI / 180);
  return 6 * sine / (3 - sine) * std::pow(2 * c4 / (1 + c4 + (1 - c4) * s), 0.25);
}

std::optional<CriticalState> read_critical_state(const TomlTable& document, const LoadedMaterial& material) {
  if (material.is_simsand) {
    if (document.has("critical_state"))
      document.fail("critical_state", "no such table, as SIMSAND has its own", "one");
    return of_simsand(material.material.properties);
  }
  const auto table = document.optional_table("critical_state");
  if (!table) return std::nullopt;
  CriticalState c;
  c.friction_angle = table->number("phi", {1, 60});
  c.e_ref = table->number("e_ref", positive);
  c.lambda = table->number("lambda", not_negative);
  c.zeta = table->number("zeta", positive);
  c.p_at = table->number("p_at", positive, 101325);
  c.p_min = 1e-5 * c.p_at;
  return c;
}

} // namespace drivers
