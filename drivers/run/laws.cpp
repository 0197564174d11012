// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/laws.hpp"
#include <cmath>
#include <limits>
#include <numbers>

namespace drivers {
namespace {

constexpr double silent = std::numeric_limits<double>::quiet_NaN();

/// A cone of slope tan(phi) with the column's volume: r_f^3 = 3 a r0^3 / tan(phi).
LawValue quasi_static_cone(double a, double friction_angle) {
  const double slope = std::tan(friction_angle * std::numbers::pi / 180);
  const double radius = std::cbrt(3 * a / slope);
  // A low column keeps a flat top: h_f cannot exceed h0, and the truncated cone keeps the volume.
  if (radius * slope <= a) return {"cone at the friction angle", radius * slope, radius - 1};
  // pi a (R^2 + R r + r^2)/3 = pi a with R - r = a / slope.
  const double width = a / slope;
  const double inner = (-3 * width + std::sqrt(9 * width * width - 12 * (width * width - 3))) / 6;
  return {"cone at the friction angle", a, inner + width - 1};
}

} // namespace

std::vector<LawValue> column_laws(host::GeometryKind geometry, double a, double friction_angle) {
  if (geometry == host::GeometryKind::plane_strain)
    return {{"Lube et al. 2005", a < 1.15 ? a : std::pow(a, 0.4),
             a < 1.8 ? 1.2 * a : (a > 2.8 ? 1.9 * std::cbrt(a * a) : silent)},
            {"Lajeunesse et al. 2005", a < 0.7 ? a : std::cbrt(a), silent}};
  // Between 1 and 1.7 Lube et al. give no height.
  std::vector<LawValue> laws{
      {"Lube et al. 2004", a <= 1 ? a : (a > 1.7 && a < 10 ? 0.88 * std::pow(a, 1.0 / 6) : silent),
       a < 1.7 ? 1.24 * a : 1.6 * std::sqrt(a)},
      {"Lajeunesse et al. 2004", a < 0.74 ? a : 0.74, a < 0.74 ? silent : 2 * std::sqrt(a) - 1}};
  if (friction_angle > 0) laws.push_back(quasi_static_cone(a, friction_angle));
  return laws;
}

} // namespace drivers
