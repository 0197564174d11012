// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/envelope.hpp"
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

void probe(MaterialCaller& material, const PointState& state, const Envelope& envelope, double duration,
           int stage, const EnvelopeSink& sink) {
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
    points = material.respond(points, increments, duration / double(envelope.increments));
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = angles[i] * 180 / M_PI;
    if (material.refused(points[i]) || !points[i].stress.allFinite())
      throw std::runtime_error(fmt::format(
          "direction {:.6g} degrees: the material {}", angle,
          material.refused(points[i]) ? "reports a failed update" : "returned a stress that is not finite"));
    sink({stage, angle, points[i].strain - state.strain, points[i].stress, points[i].stress - state.stress});
  }
}

} // namespace drivers
