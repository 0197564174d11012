// SPDX-License-Identifier: BSD-3-Clause
// The elastic trial of a substep, and the direction of plastic flow: EQUATIONS.md, "Update", 1 to 3.
#pragma once
#include "vumat/substep.hpp"

namespace simsand {

/// What rounding leaves of a sum, relative to its terms.
template <class T> inline constexpr T rounding = 4 * std::numeric_limits<T>::epsilon();

template <class Real, int N>
void find_invariants(const MaterialOf<Real>& m, const SymmetricTensor<Real, N>& strain,
                     SubstepWorkspace<Real, N>& w) {
  const auto& old = w.state;
  auto& in = w.in;
  auto& t = w.trial;
  const Real p_old = trace(old.stress) * Real(1. / 3);
  const auto s_old = add_mean(old.stress, -p_old);
  // No shear stress remains where p = 0, and what rounding leaves of an isotropic stress has no direction.
  const Mask<Real> sheared = (p_old > 0) & (deviatoric_stress(s_old) > 2 * rounding<Scalar<Real>> * p_old);
  t.s_old = scale(select(sheared, Real(1), Real(0)), s_old);
  in.volumetric = trace(strain);
  t.e_dev = add_mean(strain, in.volumetric * Real(-1. / 3));
  in.start.mean_stress = p_old;
  in.start.log_ratio = log_ratio_of_mean_stress(m, p_old);
  in.e_start = old.void_ratio;
  const Real e_middle = void_ratio_after(old.void_ratio, in.volumetric / 2);
  in.e_end = void_ratio_after(e_middle, in.volumetric / 2); // (10)
  in.bulk_factor = m.given.K0 * mean_void_ratio_factor(e_middle, in.volumetric);
  in.eps_d = old.plastic_strain;
  in.inverse_start = 1 / (m.given.k_p + in.eps_d);
  in.q_start = deviatoric_stress(t.s_old);
  in.stress_work = contract(t.s_old, t.e_dev);
  in.strain_norm = contract(t.e_dev, t.e_dev);
}

/// Mean shear modulus of the substep (13).
template <class Real>
Real mean_shear_modulus(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in,
                        const Pressure<Real>& end) {
  return m.shear_ratio * m.given.p_at * in.bulk_factor * mean_stiffness(m, in.start, end);
}

/// The elastic trials of a group, and whether they are the ends.
template <class T, class Group> void find_trials(const Material<T>& m, const Group& group) {
  group.each([&](auto& w) { find_invariants(m, scale(w.substep, w.strain), w); });
  group.each([&](auto& w) {
    w.in.start = pressure_of_mean_stress(m, w.in.start.mean_stress, w.in.start.log_ratio);
    w.trial.measure = w.in.start.measure + w.in.bulk_factor * w.in.volumetric;
    w.trial.pressure.measure = at_least(w.trial.measure, 0);
  });
  group.each(
      [&](auto& w) { w.trial.pressure.log_ratio = log_ratio_of_measure(m, w.trial.pressure.measure); });
  group.each([&](auto& w) {
    auto& t = w.trial;
    t.pressure = pressure_of_measure(m, t.pressure.measure, t.pressure.log_ratio);
    t.critical = critical_void_ratio(m, t.pressure.log_ratio);
    t.shear_modulus = mean_shear_modulus(m, w.in, t.pressure);
    t.s_trial = add(t.s_old, 2 * t.shear_modulus, t.e_dev);
    t.q = deviatoric_stress(t.s_trial);
  });
  group.each([&](auto& w) {
    w.trial.log_state_ratio = log_state_ratio(w.trial.critical, w.in.e_end);
    w.in.sin3theta = sin_3theta(w.trial.s_trial, w.trial.q);
  });
  group.each([&](auto& w) { w.trial.tangent = peak_tangent(m, w.trial.log_state_ratio); });
  group.each([&](auto& w) {
    auto& t = w.trial;
    t.peak = slope(t.tangent, w.in.sin3theta).value;
    const auto p = t.pressure.mean_stress;
    t.f = yield_function(t.q, p, t.peak, w.in.eps_d * w.in.inverse_start); // (8)
    t.is_elastic = (t.measure > 0) & (t.f <= rounding<T> * p);
  });
}

/// Non-negative x with q_trial - 3 G x = B (eps_d + x) / (k_p + eps_d + x); 0 inside the yield surface (15).
template <class Real> Real plastic_multiplier(Real q_trial, Real G, Real B, Scalar<Real> k_p, Real eps_d) {
  const Real b = 3 * G * (k_p + eps_d) - q_trial + B, c = q_trial * (k_p + eps_d) - B * eps_d;
  const Real root = sqrt(at_least(b * b + 12 * G * c, 0));
  const Mask<Real> plus = b > 0;
  const Real x = select(plus, 2 * c, root - b) / select(plus, b + root, 6 * G);
  return select(c <= 0, Real(0), x);
}

/// The direction at the end (19): half of the plastic flow is along the deviator that reaches the yield surface, half
/// along that at the end. The latter is then parallel to s_trial - 3 G x / (2 q_y) s_y.
template <class Real, int N> void turn_deviator(const MaterialOf<Real>& m, SubstepWorkspace<Real, N>& w) {
  const auto& t = w.trial;
  auto& in = w.in;
  auto& flow = w.flow;
  const Real f_start = flow.f_start =
      yield_function(in.q_start, in.start.mean_stress, in.slopes_start.peak, in.eps_d * in.inverse_start);
  flow.elastic_part = within(-f_start / positive(t.f - f_start), 0, 1);
  const auto s_yield = add(scale(1 - flow.elastic_part, t.s_old), flow.elastic_part, t.s_trial);
  const Real q_yield = deviatoric_stress(s_yield);
  const Real x =
      plastic_multiplier(t.q, t.shear_modulus, t.pressure.mean_stress * t.peak, m.given.k_p, in.eps_d);
  const Real back = at_most(Real(1.5) * t.shear_modulus * x / positive(q_yield), 1);
  flow.deviator = add(t.s_trial, -back, s_yield);
  flow.q = deviatoric_stress(flow.deviator);
  in.sin3theta = sin_3theta(flow.deviator, flow.q);
  const Real cosine = Real(1.5) * contract(s_yield, flow.deviator) / positive(q_yield * flow.q);
  flow.turn = select(q_yield > 0, at_least(2 * (1 - cosine), 0), Real(0));
}

/// The slopes at the start and the direction at the end of trials that yield.
template <class T, class Group> void find_flow(const Material<T>& m, const Group& group) {
  group.each([&](auto& w) { w.critical = critical_void_ratio(m, w.in.start.log_ratio); });
  group.each([&](auto& w) { w.log_state_ratio = log_state_ratio(w.critical, w.in.e_start); });
  group.each([&](auto& w) { set_tangents(m, w.critical, w.log_state_ratio, w.in.slopes_start); });
  group.each([&](auto& w) {
    // Without shear stress at the start, the Lode angle of the trial.
    const auto at_start = select(w.in.q_start > 0, sin_3theta(w.trial.s_old, w.in.q_start), w.in.sin3theta);
    w.in.slopes_start = at_lode_angle(w.in.slopes_start, at_start);
  });
  group.each([&](auto& w) { turn_deviator(m, w); });
}

} // namespace simsand
