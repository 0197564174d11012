// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/condition.hpp"
#include <algorithm>
#include <cmath>

namespace drivers {

Condition LinearQuantity::condition(double value) const {
  const Vector6 none = Vector6::Zero();
  return {is_strain ? none : weights, is_strain ? weights : none, value, !is_strain};
}

Vector6 weights(double a11, double a22, double a33, double a12, double a23, double a31) {
  return (Vector6() << a11, a22, a33, a12, a23, a31).finished();
}

const std::vector<LinearQuantity>& linear_quantities() {
  static const std::vector<LinearQuantity> table = [] {
    std::vector<LinearQuantity> t;
    const char* components[] = {"11", "22", "33", "12", "23", "31"};
    for (const bool strain : {true, false})
      for (int c = 0; c < 6; ++c)
        t.push_back(
            {(strain ? "strain_" : "stress_") + std::string(components[c]), strain, Vector6::Unit(c)});
    const Vector6 axial = Vector6::Unit(0), radial = weights(0, 0.5, 0.5), trace = weights(1, 1, 1),
                  difference = axial - radial, lateral = weights(0, 1, -1), shear = Vector6::Unit(3);
    t.push_back({"axial_strain", true, axial});
    t.push_back({"radial_strain", true, radial});
    t.push_back({"volumetric_strain", true, trace});
    t.push_back({"shear_strain", true, 2 * shear}); // engineering
    t.push_back({"axial_stress", false, axial});
    t.push_back({"radial_stress", false, radial});
    t.push_back({"mean_stress", false, trace / 3});
    t.push_back({"shear_stress", false, shear});
    t.push_back({"deviator", false, difference});
    t.push_back({"p", false, trace / 3});
    t.push_back({"q", false, difference});
    t.push_back({"eps_v", true, trace});
    t.push_back({"eps_q", true, 2. / 3 * difference});
    for (const bool strain : {true, false}) {
      const std::string prefix = strain ? "eps_" : "";
      t.push_back({prefix + "P", strain, trace / std::sqrt(3.)});
      t.push_back({prefix + "Q", strain, std::sqrt(2. / 3) * difference});
      t.push_back({prefix + "Z", strain, lateral / std::sqrt(2.)});
    }
    return t;
  }();
  return table;
}

const LinearQuantity* find_linear_quantity(std::string_view name) {
  const auto& all = linear_quantities();
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<std::string> linear_quantity_names() {
  std::vector<std::string> names;
  for (const auto& q : linear_quantities()) names.push_back(q.name);
  return names;
}

} // namespace drivers
