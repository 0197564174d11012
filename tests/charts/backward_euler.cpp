// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/integrators.hpp"

namespace charts {
namespace {

constexpr int most_iterations = 60;

/// The two equations of the end: volumetric elasticity (16) and yield (8), with flow of the end. Unknown are the
/// measure y and the multiplier x.
struct Problem {
  const Material& m;
  simsand::Pressure<double> start;
  Tensor s_old, deviator; ///< of stress and strain
  double volumetric, stiffening, e_end, eps_d;
};

struct Iterate {
  double y, x;
  double volume, yield; ///< residuals
  double p, G, dilatancy;
  Tensor s_trial;
  double q_trial;
  double volume_y, volume_x, yield_y, yield_x; ///< their derivatives
};

Iterate evaluate(const Problem& a, double y, double x) {
  const Material& m = a.m;
  Iterate at{};
  at.y = y;
  at.x = x;
  const auto end = simsand::pressure_of_measure(m, y);
  const double p = at.p = end.mean_stress, stiff = m.shear_ratio * m.given.p_at * a.stiffening;
  at.G = stiff * (a.start.stiffness + end.stiffness) / 2;
  at.s_trial = simsand::add(a.s_old, 2 * at.G, a.deviator);
  at.q_trial = simsand::deviatoric_stress(at.s_trial);
  const double sine = simsand::sin_3theta(at.s_trial, at.q_trial);
  const auto M = simsand::slopes(m, a.e_end, end, sine);
  const double b = m.given.k_p + a.eps_d + x, h = (a.eps_d + x) / b;
  at.dilatancy = simsand::dilatancy(m, M.transformation, M.peak, h);
  at.volume = y - a.start.measure - a.stiffening * (a.volumetric - x * at.dilatancy);
  at.yield = at.q_trial - 3 * at.G * x - p * M.peak * h;
  const bool floored = p <= m.given.p_min;
  const double p_y = m.given.p_at * end.stiffness; // dp/dy
  const double log_y = floored ? 0 : p_y / p;      // d ln p/dy above p_min
  const double G_y = floored ? 0 : stiff / 2 * m.given.n * end.stiffness * log_y;
  const double M_y = m.given.n_p * M.peak * M.peak_rate * M.critical_rate * log_y;
  const double Mpt_y = -m.given.n_d * M.transformation * M.transformation_rate * M.critical_rate * log_y;
  const double q_G = at.q_trial > 0 ? 3 * simsand::contract(at.s_trial, a.deviator) / at.q_trial : 0;
  const double h_x = m.given.k_p / (b * b);
  at.volume_y = 1 + a.stiffening * x * m.given.A_d * (Mpt_y - M_y * h);
  at.volume_x = a.stiffening * (at.dilatancy - x * m.given.A_d * M.peak * h_x);
  at.yield_y = (q_G - 3 * x) * G_y - (p_y * M.peak + p * M_y) * h;
  at.yield_x = -3 * at.G - p * M.peak * h_x;
  return at;
}

Answer solve(const Material& m, const Point& old, const Tensor& strain) {
  const auto trial = elastic_answer(m, old, strain);
  if (trial.measure > 0 && yield_of(m, trial.point) <= 1e-12 * mean(trial.point.stress)) return {trial.point};
  const double volumetric = simsand::trace(strain);
  const auto start = simsand::pressure_of_mean_stress(m, mean(old.stress));
  const Problem problem{m,
                        start,
                        simsand::deviator(old.stress),
                        simsand::deviator(strain),
                        volumetric,
                        trial.stiffening,
                        trial.point.void_ratio,
                        old.plastic_strain};
  const auto size = [&](const Iterate& i) {
    return std::abs(i.volume) / (i.y + m.floor_measure) +
           std::abs(i.yield) / std::max(i.p, simsand::tiny<double>);
  };
  auto at = evaluate(problem, std::max(trial.measure, m.floor_measure * 1e-3), 0);
  for (int i = 0; i < most_iterations; ++i) {
    if (std::abs(at.volume) <= 1e-11 * (at.y + m.floor_measure) && std::abs(at.yield) <= 1e-10 * at.p) {
      if (at.x < 0) return {old, false};
      const double q = at.q_trial - 3 * at.G * at.x;
      const auto s = simsand::scale(q / at.q_trial, at.s_trial);
      return {{simsand::add_mean(s, at.p), trial.point.void_ratio, old.plastic_strain + at.x, 0}};
    }
    const double determinant = at.volume_y * at.yield_x - at.volume_x * at.yield_y;
    const double dy = -(at.volume * at.yield_x - at.volume_x * at.yield) / determinant;
    const double dx = -(at.volume_y * at.yield - at.volume * at.yield_y) / determinant;
    double length = 1;
    Iterate next = at;
    for (int k = 0; k < 12; ++k, length /= 2) {
      const double y = std::max(at.y + length * dy, at.y * 1e-2), x = std::max(at.x + length * dx, 0.);
      next = evaluate(problem, y, x);
      if (size(next) < size(at)) break;
    }
    at = next;
    if (at.p < 1e-9 * m.given.p_min) break;
  }
  // At zero pressure all shear is plastic: whether volume is left to be closed there.
  const auto empty = evaluate(problem, 0, 0);
  const auto end = evaluate(problem, 0, empty.q_trial / (3 * empty.G));
  if (end.volume > 0) return {parted(m, old, volumetric, end.dilatancy * end.x, end.x)};
  return {old, false};
}

} // namespace

Answer backward_euler(const Material& m, const Point& old, const Tensor& strain) {
  return after_gap(old, strain, [&](const Point& p, const Tensor& e) { return solve(m, p, e); });
}

} // namespace charts
