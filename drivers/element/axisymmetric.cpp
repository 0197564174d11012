// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/axisymmetric.hpp"
#include <algorithm>
#include <cmath>
#include <optional>

namespace drivers {
namespace {

AxisymmetricCondition reduced(const Condition& c) {
  return {{c.stress[0], c.stress[1] + c.stress[2]}, {c.strain[0], c.strain[1] + c.strain[2]}};
}

/// All weights: axial and radial stress, axial and radial strain.
Eigen::Vector4d weights_of(const AxisymmetricCondition& c) {
  return {c.stress.axial, c.stress.radial, c.strain.axial, c.strain.radial};
}

/// Whether two conditions are multiples of each other.
bool equivalent(const AxisymmetricCondition& a, const AxisymmetricCondition& b) {
  const auto one = weights_of(a).normalized(), other = weights_of(b).normalized();
  return std::abs(std::abs(one.dot(other)) - 1) < 1e-12;
}

/// The test of a preset; none where axial strain does not drive it or its conditions do not come down to one.
std::optional<AxisymmetricTest> test_of(const Preset& preset) {
  if (preset.shears || !preset.ratio.empty() || preset.drives.front() != "axial_strain") return std::nullopt;
  std::optional<AxisymmetricCondition> held;
  for (const auto& condition : preset.held) {
    const auto here = reduced(condition);
    if (weights_of(here).isZero(0)) continue; // 22 = 33, which symmetry provides
    if (held && !equivalent(*held, here)) return std::nullopt;
    held = here;
  }
  if (!held) return std::nullopt;
  return AxisymmetricTest{preset.name, *held};
}

} // namespace

double AxisymmetricTest::strain_ratio() const {
  if (prescribes_strain()) return -held.strain.axial / held.strain.radial;
  // Stress increments in units of G for the strain increments (1, x): axial 3 + 2 x, radial 1 + 4 x.
  return -(3 * held.stress.axial + held.stress.radial) / (2 * held.stress.axial + 4 * held.stress.radial);
}

bool AxisymmetricTest::holds(std::string_view quantity) const {
  return equivalent(held, reduced(find_linear_quantity(quantity)->condition()));
}

const std::vector<AxisymmetricTest>& axisymmetric_tests() {
  static const auto table = [] {
    std::vector<AxisymmetricTest> tests;
    for (const auto& preset : presets())
      if (const auto test = test_of(preset)) tests.push_back(*test);
    return tests;
  }();
  return table;
}

const AxisymmetricTest* find_axisymmetric_test(std::string_view name) {
  const auto& all = axisymmetric_tests();
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& t) { return t.name == name; });
  return at == all.end() ? nullptr : &*at;
}

} // namespace drivers
