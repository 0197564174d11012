// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/integrators.hpp"

namespace charts {
namespace {

constexpr int most_iterations = 100;

Answer relax(const Material& m, const Point& old, const Tensor& strain) {
  const double volumetric = simsand::trace(strain);
  const auto trial = elastic_answer(m, old, strain);
  if (!(trial.measure > 0)) return {parted(m, old, volumetric, 0, 0)};
  Point point = trial.point;
  double plastic_volumetric = 0;
  for (int i = 0; i < most_iterations; ++i) {
    const auto at = local(m, point, strain);
    if (at.f <= 1e-9 * at.p && (i == 0 || at.f >= -1e-9 * at.p)) return {point};
    const double x = at.f / consistency(at); // (8) linearised along the flow
    point = moved(point, x,
                  {simsand::add_mean(simsand::scale(-3 * at.G, at.direction), -at.K * at.dilatancy), 0, 1});
    plastic_volumetric += x * at.dilatancy;
    if (!(mean(point.stress) > 0) || point.plastic_strain < old.plastic_strain) {
      if (mean(point.stress) <= 0 && at.dilatancy > 0)
        return {parted(m, old, volumetric, plastic_volumetric, point.plastic_strain - old.plastic_strain)};
      return {old, false};
    }
  }
  return {old, false};
}

} // namespace

Answer cutting_plane(const Material& m, const Point& old, const Tensor& strain) {
  return after_gap(old, strain, [&](const Point& p, const Tensor& e) { return relax(m, p, e); });
}

} // namespace charts
