// SPDX-License-Identifier: BSD-3-Clause
// The mean stress at the end of a substep, sought as its measure y (12): EQUATIONS.md, "Update", 3 to 5. The yield
// condition gives the multiplier of every y in closed form; the volumetric strain (16) decides which y is right.
#pragma once
#include "vumat/trial.hpp"

namespace simsand {

/// Most evaluations of all functions by Newton's rule.
inline constexpr int largest_newton_count = 5;

/// Tolerance on the residual of (16) relative to y.
template <class T> inline constexpr T tolerance = std::max(T(1e-12), 8 * std::numeric_limits<T>::epsilon());

/// Relative error of M that the last step by series may leave, and the largest change of ln p of such a step.
template <class T>
inline constexpr T series_error = std::max(T(1e-12), 4 * std::numeric_limits<T>::epsilon());
inline constexpr double largest_last_step = 1e-3;

/// All that follows from the pressure at the end of the substep and the slopes there.
template <class Real>
void evaluate(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in, EndCandidate<Real>& c) {
  const Real p = c.pressure.mean_stress;
  const Real G = c.shear_modulus = mean_shear_modulus(m, in, c.pressure);
  c.q_trial = sqrt(at_least(in.q_start * in.q_start + 6 * G * (in.stress_work + G * in.strain_norm), 0));
  const Real x = c.multiplier =
      plastic_multiplier(c.q_trial, G, p * c.slopes.peak, m.given.k_p, in.eps_d); // (15)
  const Real eps_d = in.eps_d + x;                                                // (11)
  c.inverse = 1 / (m.given.k_p + eps_d);
  c.mobilised = eps_d * c.inverse;
  c.mean_mobilised = mean_mobilised(m, in.inverse_start, x);
  c.plastic_volumetric = x * dilatancy(m, (in.slopes_start.transformation + c.slopes.transformation) / 2,
                                       (in.slopes_start.peak + c.slopes.peak) / 2, c.mean_mobilised); // (9)
  c.residual =
      c.pressure.measure - in.start.measure - in.bulk_factor * (in.volumetric - c.plastic_volumetric); // (16)
}

/// d residual / d y.
template <class Real>
Real residual_slope(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in,
                    const EndCandidate<Real>& c) {
  const Real p = c.pressure.mean_stress, G = c.shear_modulus, M_p = c.slopes.peak,
             M_pt = c.slopes.transformation;
  const Real hardening = p * M_p * m.given.k_p * c.inverse * c.inverse;
  const Real p_dM_p = m.given.n_p * M_p * c.slopes.peak_rate * c.slopes.critical_rate;
  const Real p_dM_pt = -m.given.n_d * M_pt * c.slopes.transformation_rate * c.slopes.critical_rate;
  // p dG / dp times (dq/dG of the trial less 3 x), the change of q with the shear modulus.
  const Real p_dG = m.given.n / 2 * m.shear_ratio * m.given.p_at * in.bulk_factor * c.pressure.stiffness;
  const Real dq_dG = 3 * (in.stress_work + 2 * G * in.strain_norm) / positive(c.q_trial) - 3 * c.multiplier;
  const Real p_dx = (p_dG * dq_dG - p * (M_p + p_dM_p) * c.mobilised) / (3 * G + hardening);
  const Real D = dilatancy(m, (in.slopes_start.transformation + M_pt) / 2, (in.slopes_start.peak + M_p) / 2,
                           c.mobilised);
  const Real p_dD = m.given.A_d / 2 * (p_dM_pt - p_dM_p * c.mean_mobilised);
  const Real y_dy = m.given.p_at * c.pressure.stiffness / positive(p);
  const Real slope =
      1 + select(c.multiplier > 0, in.bulk_factor * (D * p_dx + c.multiplier * p_dD) * y_dy, Real(0));
  return at_least(slope, 0.1);
}

/// Largest multiplier, that of a stress which vanishes at the end.
template <class Real> Real largest_multiplier(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in) {
  const Real G_least =
      (1 - m.given.n) / 2 * m.shear_ratio * m.given.p_at * in.bulk_factor * in.start.stiffness;
  return sqrt(Real(2. / 3) * in.strain_norm) + in.q_start / (3 * G_least);
}

/// Whether a candidate solves (16), but for what rounding leaves of its terms.
template <class Real>
Mask<Real> is_solution(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in,
                       const EndCandidate<Real>& c, Real largest_x) {
  const Real terms = in.start.measure + in.bulk_factor * (abs(in.volumetric) + m.given.A_d * largest_x);
  return abs(c.residual) <=
         tolerance<Scalar<Real>> * (c.pressure.measure + m.floor_measure) + rounding<Scalar<Real>> * terms;
}

/// A guess of the end: the pressure of the start, or of the trial where that compresses much; slopes near enough.
template <class Real>
void guess_end(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in, const Pressure<Real>& trial,
               EndCandidate<Real>& c) {
  const Mask<Real> compressed = trial.measure > 2 * in.start.measure;
  c.pressure.mean_stress = select(compressed, trial.mean_stress, in.start.mean_stress);
  c.pressure.measure = select(compressed, trial.measure, in.start.measure);
  c.pressure.stiffness = select(compressed, trial.stiffness, in.start.stiffness);
  c.pressure.log_ratio = select(compressed, trial.log_ratio, in.start.log_ratio);
  const Real denser = 2 * (in.e_start - in.e_end) / (in.e_start + in.e_end) +
                      in.slopes_start.critical_rate * (c.pressure.log_ratio - in.start.log_ratio);
  c.slopes = roughly_shifted(m, in.slopes_start, denser, in.sin3theta);
}

/// Pressure and slopes after a change of y, by series from where they are.
template <class Real>
void shift(const MaterialOf<Real>& m, const EndCandidate<Real>& from, Real measure_step,
           EndCandidate<Real>& to) {
  const Real log_ratio = from.pressure.log_ratio;
  to.pressure = shifted(m, from.pressure, measure_step);
  to.slopes = shifted(m, from.slopes, to.pressure.log_ratio - log_ratio);
}

/// Whether a step by series is short enough: what it leaves out of M grows with the square of the change.
template <class Real>
Mask<Real> is_short_step(const MaterialOf<Real>& m, const EndCandidate<Real>& from,
                         const EndCandidate<Real>& to) {
  const Real change = abs(to.pressure.log_ratio - from.pressure.log_ratio);
  const Real rate = std::max(m.given.n_p, m.given.n_d) * abs(from.slopes.critical_rate);
  const Real left_out = change * change * rate * (1 + rate);
  return (left_out <= Real(series_error<Scalar<Real>>)) & (change <= Real(largest_last_step));
}

/// One step of Newton's rule from a candidate to `end`, with p and M by series.
template <class Real, int N>
void newton_step(const MaterialOf<Real>& m, const RegisterGroup<Real, N>& group,
                 EndCandidate<Real> SubstepWorkspace<Real, N>::*from) {
  group.each([&](auto& w) { w.measure_step = -(w.*from).residual / residual_slope(m, w.in, w.*from); });
  group.each([&](auto& w) { shift(m, w.*from, w.measure_step, w.end); });
  group.each([&](auto& w) { evaluate(m, w.in, w.end); });
}

/// All functions at the measure that a group has reached.
template <class Real, int N>
void evaluate_in_full(const MaterialOf<Real>& m, const RegisterGroup<Real, N>& group) {
  group.each([&](auto& w) { w.full.pressure.log_ratio = log_ratio_of_measure(m, w.measure); });
  group.each([&](auto& w) {
    w.full.pressure = pressure_of_measure(m, w.measure, w.full.pressure.log_ratio);
    w.critical = critical_void_ratio(m, w.full.pressure.log_ratio);
  });
  group.each([&](auto& w) { w.log_state_ratio = log_state_ratio(w.critical, w.in.e_end); });
  group.each([&](auto& w) { set_tangents(m, w.critical, w.log_state_ratio, w.full.slopes); });
  group.each([&](auto& w) { w.full.slopes = at_lode_angle(w.full.slopes, w.in.sin3theta); });
  group.each([&](auto& w) { evaluate(m, w.in, w.full); });
}

/// Newton's rule from the start, each point until it is solved. Two steps by series lead to the neighbourhood of the
/// answer; all functions are evaluated there, and one more step by series, too short for an error, ends it. Points
/// that this leaves unsolved, or that head for y = 0, are for shorter substeps.
template <class Real, int N> void solve(const MaterialOf<Real>& m, RegisterGroup<Real, N> group) {
  using Workspace = SubstepWorkspace<Real, N>;
  group.each([&](auto& w) { guess_end(m, w.in, w.trial.pressure, w.full); });
  group.each([&](auto& w) { evaluate(m, w.in, w.full); });
  newton_step(m, group, &Workspace::full);
  newton_step(m, group, &Workspace::end);
  group.each([&](auto& w) { w.measure = at_least(w.end.pressure.measure, 0); });
  for (int k = 0; k <= largest_newton_count && group.count > 0; ++k) {
    evaluate_in_full(m, group);
    newton_step(m, group, &Workspace::full);
    group.each([&](auto& w) {
      const Real largest_x = largest_multiplier(m, w.in);
      w.solved |= is_solution(m, w.in, w.end, largest_x) & is_short_step(m, w.full, w.end);
      w.measure = select(w.solved, w.measure, at_least(w.end.pressure.measure, 0));
    });
    group = group.remaining(&Workspace::solved);
  }
}

} // namespace simsand
