// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/bounds.hpp"
#include <algorithm>
#include <cmath>

namespace drivers {
namespace {

std::function<double(const ElementRow&)> value_of(const LinearQuantity& quantity) {
  return [c = quantity.condition()](const ElementRow& r) { return c.at(r.point.stress, r.point.strain); };
}

} // namespace

std::vector<Bound> bounds_of(const std::vector<StopRule>& stops, const std::vector<OutputColumn>& columns) {
  std::vector<Bound> bounds;
  for (const auto& rule : stops) {
    if (rule.critical_tolerance > 0) continue;
    const auto column =
        std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == rule.quantity; });
    bounds.push_back(
        {column != columns.end() ? column->value : value_of(*find_linear_quantity(rule.quantity)), rule.above,
         rule.bound});
  }
  return bounds;
}

std::vector<Bound> bounds_of(const Cycling& cycling, bool upwards, const ElementRow& start) {
  std::vector<Bound> bounds;
  for (const auto& limit : cycling.limits) {
    const auto value = value_of(*limit.quantity);
    const double zero = limit.quantity->is_strain ? value(start) : 0;
    bounds.push_back({value, upwards, zero + (upwards ? limit.upper : limit.lower)});
  }
  return bounds;
}

bool is_critical(const CriticalState& critical, double initial_void_ratio, double tolerance,
                 const ElementRow& before, const ElementRow& now) {
  const auto& stress = now.point.stress;
  const double p = mean_stress(stress), ratio = critical.stress_ratio(lode_angle(stress));
  if (!(p > 0)) return false;
  const Vector6 increment = now.point.strain - before.point.strain;
  return std::abs(volumetric_strain(increment)) < tolerance * deviatoric_strain(increment) &&
         std::abs(deviatoric_stress(stress) / p - ratio) < tolerance * ratio &&
         std::abs(void_ratio_after(initial_void_ratio, now.point.strain) - critical.void_ratio(p)) <
             tolerance;
}

} // namespace drivers
