// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/elastic.hpp"

namespace charts {

Elastic elastic_answer(const Material& m, const Point& old, const Tensor& strain) {
  const double volumetric = simsand::trace(strain);
  const auto start = simsand::pressure_of_mean_stress(m, mean(old.stress));
  const double e_middle = simsand::void_ratio_after(old.void_ratio, volumetric / 2);
  Elastic out;
  out.stiffening = m.given.K0 * simsand::mean_void_ratio_factor(e_middle, volumetric);
  out.measure = start.measure + out.stiffening * volumetric;
  const auto end = simsand::pressure_of_measure(m, std::max(out.measure, 0.));
  const double G = m.shear_ratio * m.given.p_at * out.stiffening * (start.stiffness + end.stiffness) / 2;
  out.point = old;
  out.point.void_ratio = simsand::void_ratio_after(e_middle, volumetric / 2);
  if (out.measure > 0)
    out.point.stress = simsand::add_mean(
        simsand::add(simsand::deviator(old.stress), 2 * G, simsand::deviator(strain)), end.mean_stress);
  else
    out.point.stress = {};
  return out;
}

double elastic_share(const Material& m, const Point& old, const Tensor& strain) {
  const auto f = [&](double share) {
    return yield_of(m, elastic_answer(m, old, simsand::scale(share, strain)).point);
  };
  const double p = mean(old.stress), f_start = yield_of(m, old);
  const auto end = elastic_answer(m, old, strain);
  if (end.measure > 0 && yield_of(m, end.point) <= 1e-12 * mean(end.point.stress)) return 1;
  double low = 0, f_low = f_start, high = 1, f_high = f(1);
  if (f_start >= -1e-10 * p) {
    if (!(p > 0) || elastic_growth(local(m, old, strain), strain) >= 0) return 0;
    do { // unloads first: a point inside
      high /= 4;
      f_low = f(high);
    } while (f_low >= 0 && high > 1e-6);
    low = high;
    high = 1;
    if (f_low >= 0) return 0;
  }
  if (end.measure <= 0) { // p vanishes on the way: the last point with stress, yielding or not
    const auto measure = [&](double share) {
      return elastic_answer(m, old, simsand::scale(share, strain)).measure;
    };
    high = simsand::pressure_of_mean_stress(m, p).measure / (end.stiffening * -simsand::trace(strain));
    while (measure(high = std::min(high, 1.)) <= 0) high *= 0.999;
    f_high = f(high);
    if (f_high <= 0) return 1;
  }
  for (int i = 0; i < 30; ++i) {
    const double next = high - f_high * (high - low) / (f_high - f_low), f_next = f(next);
    if (std::abs(f_next) <= 1e-11 * p) return next;
    if (f_next * f_high < 0) {
      low = high;
      f_low = f_high;
    } else {
      f_low *= f_high / (f_high + f_next);
    }
    high = next;
    f_high = f_next;
  }
  return high;
}

Point parted(const Material& m, const Point& old, double volumetric, double plastic_volumetric,
             double multiplier) {
  const double emptied = simsand::pressure_of_mean_stress(m, mean(old.stress)).measure /
                         (m.given.K0 * simsand::void_ratio_factor(old.void_ratio));
  const double gap = std::max(plastic_volumetric - volumetric - emptied, simsand::tiny<double>);
  return {{}, simsand::void_ratio_after(old.void_ratio, volumetric), old.plastic_strain + multiplier, gap};
}

bool correct_drift(const Material& m, Point& point, const Tensor& strain) {
  for (int i = 0; i < 10; ++i) {
    if (!(mean(point.stress) > 0)) return false;
    const auto at = local(m, point, strain);
    if (std::abs(at.f) <= 1e-9 * at.p) return true;
    const double x = at.f / consistency(at);
    point = moved(point, x,
                  {simsand::add_mean(simsand::scale(-3 * at.G, at.direction), -at.K * at.dilatancy), 0, 1});
  }
  return false;
}

} // namespace charts
