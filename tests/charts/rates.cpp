// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/rates.hpp"

namespace charts {
namespace {

/// s.s for a symmetric tensor.
Tensor squared(const Tensor& s) {
  return {{s[0] * s[0] + s[3] * s[3] + s[5] * s[5], s[3] * s[3] + s[1] * s[1] + s[4] * s[4],
           s[5] * s[5] + s[4] * s[4] + s[2] * s[2], s[0] * s[3] + s[3] * s[1] + s[5] * s[4],
           s[3] * s[5] + s[1] * s[4] + s[4] * s[2], s[0] * s[5] + s[3] * s[4] + s[5] * s[2]}};
}

/// d sin 3theta / d s times q, of a deviator n = s/q: -27/2 ((n.n)' - 9/2 det n n).
Tensor angle_gradient(const Tensor& n) {
  return simsand::scale(-13.5,
                        simsand::add(simsand::deviator(squared(n)), -4.5 * simsand::determinant(n), n));
}

/// dM / d sin 3theta, from (18).
double angle_slope(double M, double tangent, double sin3theta) {
  const double r = std::sqrt(1 + tangent * tangent), a = 3 * r - tangent, b = 3 * r + tangent;
  const double a4 = a * a * a * a, b4 = b * b * b * b;
  return -0.25 * M * (b4 - a4) / (b4 * (1 + sin3theta) + a4 * (1 - sin3theta));
}

} // namespace

Local local(const Material& m, const Point& point, const Tensor& deviator_hint) {
  Local at;
  at.p = mean(point.stress);
  const auto s = simsand::deviator(point.stress);
  at.q = simsand::deviatoric_stress(s);
  at.direction = at.q > 1e-12 * at.p ? simsand::scale(1 / at.q, s) : unit_deviator(deviator_hint);
  const double sin3theta = simsand::sin_3theta(at.direction, 1.);
  const auto pressure = simsand::pressure_of_mean_stress(m, at.p);
  const auto M = simsand::slopes(m, point.void_ratio, pressure, sin3theta);
  const double h = simsand::mobilised(m, point.plastic_strain), b = m.given.k_p + point.plastic_strain;
  at.K = simsand::bulk_modulus(m, point.void_ratio, pressure);
  at.G = m.shear_ratio * at.K;
  at.f = simsand::yield_function(at.q, at.p, M.peak, h);
  at.dilatancy = simsand::dilatancy(m, M.transformation, M.peak, h);
  const bool floored = at.p < m.given.p_min;
  const double M_of_density = m.given.n_p * M.peak * M.peak_rate; // dM / d ln(e_c / e)
  at.f_p = -h * (M.peak + (floored ? 0 : M_of_density * M.critical_rate));
  at.f_e = at.p * h * M_of_density / point.void_ratio;
  at.hardening = at.p * M.peak * m.given.k_p / (b * b);
  at.void_per_strain = 1 + point.void_ratio;
  const double turning =
      -at.p * h * angle_slope(M.peak, M.peak_tangent, sin3theta) / std::max(at.q, 1e-12 * at.p);
  at.f_s = simsand::add(simsand::scale(1.5, at.direction), turning, angle_gradient(at.direction));
  return at;
}

double elastic_growth(const Local& at, const Tensor& strain) {
  const double volumetric = simsand::trace(strain);
  return 2 * at.G * simsand::contract(at.f_s, simsand::deviator(strain)) +
         (at.f_p * at.K - at.f_e * at.void_per_strain) * volumetric;
}

double consistency(const Local& at) {
  return 3 * at.G + at.f_p * at.K * at.dilatancy + at.hardening;
}

Rate elastic_rate(const Local& at, const Tensor& strain) {
  const double volumetric = simsand::trace(strain);
  return {simsand::add_mean(simsand::scale(2 * at.G, simsand::deviator(strain)), at.K * volumetric),
          -at.void_per_strain * volumetric, 0};
}

Rate plastic_rate(const Local& at, const Tensor& strain) {
  Rate rate = elastic_rate(at, strain);
  rate.eps_d = std::max(elastic_growth(at, strain), 0.) / consistency(at);
  rate.stress = simsand::add_mean(simsand::add(rate.stress, -3 * at.G * rate.eps_d, at.direction),
                                  -at.K * at.dilatancy * rate.eps_d);
  return rate;
}

Point moved(const Point& from, double h, const Rate& rate) {
  return {simsand::add(from.stress, h, rate.stress),
          std::max(from.void_ratio + h * rate.e, simsand::smallest_void_ratio),
          from.plastic_strain + h * rate.eps_d, 0};
}

double yield_of(const Material& m, const Point& point) {
  const double p = mean(point.stress);
  if (!(p > 0)) return 0;
  const auto s = simsand::deviator(point.stress);
  const double q = simsand::deviatoric_stress(s);
  const auto M =
      simsand::slopes(m, point.void_ratio, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(s, q));
  return simsand::yield_function(q, p, M.peak, simsand::mobilised(m, point.plastic_strain));
}

} // namespace charts
