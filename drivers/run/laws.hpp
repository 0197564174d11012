// SPDX-License-Identifier: BSD-3-Clause
// Published laws for the collapse of columns, and the quasi-static bound, as functions of the aspect
// ratio a = height / radius (channel: height / length). Sources and how sure each is: data/experiments.
#pragma once
#include "host/scene.hpp"

namespace drivers {

/// Height h_f/r0 and runout (r_f - r0)/r0 by one law; NaN outside of the law's range.
struct LawValue {
  std::string source;
  double height, runout;
};

/// The laws for this geometry, and in axisymmetry the cone at the friction angle (degrees) that keeps the
/// volume.
std::vector<LawValue> column_laws(host::GeometryKind geometry, double aspect_ratio, double friction_angle);

} // namespace drivers
