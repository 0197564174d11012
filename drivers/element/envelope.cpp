// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/envelope.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {

Envelope read_envelope(const TomlTable& table) {
  Envelope e;
  e.strain_norm = table.number("strain_norm", positive);
  e.directions = table.integer("directions", {3, 1e6}, e.directions);
  e.increments = table.integer("increments", {1, 1e6}, e.increments);
  return e;
}

namespace {

double degrees(double angle) {
  return angle * 180 / M_PI;
}

/// Takes each point through one increment.
void advance_all(MaterialCaller& material, const std::vector<Vector6>& increments, double dt,
                 const std::vector<double>& angles, const std::string& failed_point,
                 std::vector<PointState>& points) {
  points = material.respond(points, increments, dt);
  if (std::all_of(points.begin(), points.end(), [&](const auto& p) { return material.usable(p); })) return;
  throw std::runtime_error(fmt::format("direction {:.6g} degrees: {}", degrees(angles[material.failed_point]),
                                       material.evidence(failed_point)));
}

} // namespace

void probe(MaterialCaller& material, const PointState& state, const Envelope& envelope, double duration,
           int stage, const EnvelopeSink& sink, const std::string& failed_point) {
  const std::size_t n = std::size_t(envelope.directions);
  std::vector<double> angles(n);
  std::vector<Vector6> increments(n);
  for (std::size_t i = 0; i < n; ++i) {
    angles[i] = 2 * M_PI * double(i) / double(n);
    const double radial = std::cos(angles[i]) / std::sqrt(2.), axial = std::sin(angles[i]);
    increments[i] = envelope.strain_norm / double(envelope.increments) * weights(axial, radial, radial);
  }
  std::vector<PointState> points(n, state);
  for (long step = 0; step < envelope.increments; ++step)
    advance_all(material, increments, duration / double(envelope.increments), angles, failed_point, points);
  for (std::size_t i = 0; i < n; ++i)
    sink({stage, degrees(angles[i]), points[i].strain - state.strain, points[i].stress,
          points[i].stress - state.stress});
}

} // namespace drivers
