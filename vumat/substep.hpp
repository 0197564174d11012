// SPDX-License-Identifier: BSD-3-Clause
// One substep of points that carry stress: EQUATIONS.md, section "Update". The same functions serve a point
// and lanes of points.
#pragma once
#include "vumat/end_pressure.hpp"
#include "vumat/simsand.hpp"

namespace simsand {

/// Accepted error of a substep (20).
inline constexpr double substep_tolerance = 0.05;
/// Substeps are counted in ticks; an increment is so many, the smallest substep is one.
inline constexpr int ticks_per_increment = 65536;

template <class Real, int N> struct Substep {
  Point<Real, N> point;
  Real dissipation, error;
  Mask<Real> plastic, nonconvex;
};

/// The elastic trial of a substep, and where it turns the deviator to.
template <class Real, int N> struct Trial {
  Increment<Real> in;
  SymmetricTensor<Real, N> s_old, s_trial, e_dev; ///< deviators
  Real measure;                                   ///< y, not bounded
  Pressure<Real> pressure;
  Real critical, density; ///< void ratio e_c, ln (e_c / e)
  Real tangent, peak;     ///< of the peak friction angle; M_p
  Real q, shear_modulus;
  Real f;            ///< of (8)
  Mask<Real> inside; ///< the step is elastic
};

/// The deviator that plastic flow leads to.
template <class Real, int N> struct Flow {
  SymmetricTensor<Real, N> direction;
  Real q, turn;      ///< invariant of `direction`; 2 (1 - cos psi)
  Real elastic_part; ///< of the trial, before the yield surface
};

// The elastic trial in parts, each with one long function: lanes run every part over many points before the next, so that
// the processor finds work while a logarithm is under way.

template <class Real, int N>
void begin_trial(const MaterialOf<Real>& m, const Point<Real, N>& old, const SymmetricTensor<Real, N>& strain,
                 Trial<Real, N>& t) {
  const Real p_old = trace(old.stress) * Real(1. / 3);
  const auto s_old = add_mean(old.stress, -p_old);
  // None outlives p = 0, and what rounding leaves of an isotropic stress has no direction.
  const Mask<Real> shear = (p_old > 0) & (deviatoric_stress(s_old) > 2 * rounding<Scalar<Real>> * p_old);
  t.s_old = scale(select(shear, Real(1), Real(0)), s_old);
  Increment<Real>& in = t.in;
  in.volumetric = trace(strain);
  t.e_dev = add_mean(strain, in.volumetric * Real(-1. / 3));
  in.start.mean_stress = p_old;
  in.start.log_ratio = log_ratio_of_mean_stress(m, p_old);
  in.e_start = old.void_ratio;
  const Real e_middle = void_ratio_after(old.void_ratio, in.volumetric * Real(0.5));
  in.e_end = void_ratio_after(e_middle, in.volumetric * Real(0.5));
  in.stiffening = m.given.K0 * mean_void_ratio_factor(e_middle, in.volumetric);
  in.eps_d = old.plastic_strain;
  in.inverse_start = 1 / (m.given.k_p + in.eps_d);
  in.q_start = deviatoric_stress(t.s_old);
  in.stress_work = contract(t.s_old, t.e_dev);
  in.strain_norm = contract(t.e_dev, t.e_dev);
}

template <class Real, int N> void trial_measure(const MaterialOf<Real>& m, Trial<Real, N>& t) {
  Increment<Real>& in = t.in;
  in.start = pressure_of_mean_stress(m, in.start.mean_stress, in.start.log_ratio);
  t.measure = in.start.measure + in.stiffening * in.volumetric;
  t.pressure.measure = max(t.measure, Real(0));
}

template <class Real, int N> void trial_log_ratio(const MaterialOf<Real>& m, Trial<Real, N>& t) {
  t.pressure.log_ratio = log_ratio_of_measure(m, t.pressure.measure);
}

template <class Real, int N> void trial_pressure(const MaterialOf<Real>& m, Trial<Real, N>& t) {
  t.pressure = pressure_of_measure(m, t.pressure.measure, t.pressure.log_ratio);
  t.critical = critical_void_ratio(m, t.pressure.log_ratio);
  t.shear_modulus = mean_shear_modulus(m, t.in, t.pressure);
  t.s_trial = add(t.s_old, 2 * t.shear_modulus, t.e_dev);
  t.q = deviatoric_stress(t.s_trial);
}

template <class Real, int N> void trial_density(const MaterialOf<Real>&, Trial<Real, N>& t) {
  t.density = density(t.critical, t.in.e_end);
  t.in.sin3theta = sin_3theta(t.s_trial, t.q);
}

template <class Real, int N> void trial_tangent(const MaterialOf<Real>& m, Trial<Real, N>& t) {
  t.tangent = peak_tangent(m, t.density);
}

template <class Real, int N> void end_trial(const MaterialOf<Real>&, Trial<Real, N>& t) {
  t.peak = slope(t.tangent, t.in.sin3theta).value;
  const Real p = t.pressure.mean_stress;
  t.f = yield_function(t.q, p, t.peak, t.in.eps_d * t.in.inverse_start); // (8)
  t.inside = (t.measure > 0) & (t.f <= rounding<Scalar<Real>> * p);
}

/// The elastic trial and whether it is the answer.
template <class Real, int N>
Trial<Real, N> elastic_trial(const MaterialOf<Real>& m, const Point<Real, N>& old,
                             const SymmetricTensor<Real, N>& strain) {
  Trial<Real, N> t;
  begin_trial(m, old, strain, t);
  trial_measure(m, t);
  trial_log_ratio(m, t);
  trial_pressure(m, t);
  trial_density(m, t);
  trial_tangent(m, t);
  end_trial(m, t);
  return t;
}

/// Lode angle at the start; without shear stress there, that of the trial.
template <class Real, int N> Real start_sin_3theta(const Trial<Real, N>& t) {
  return select(t.in.q_start > 0, sin_3theta(t.s_old, t.in.q_start), t.in.sin3theta);
}

/// The flow direction at mid-step (19): where half of the plastic flow is along the deviator that reaches the yield
/// surface and half along that at the end, the latter is parallel to s_trial - 3 G x / (2 q) s.
template <class Real, int N> Flow<Real, N> turn_deviator(const MaterialOf<Real>& m, Trial<Real, N>& t) {
  Increment<Real>& in = t.in;
  const Real f_start =
      yield_function(in.q_start, in.start.mean_stress, in.slopes_start.peak, in.eps_d * in.inverse_start);
  const Real tiny_stress = tiny<Scalar<Real>>;
  Flow<Real, N> flow;
  flow.elastic_part = min(max(-f_start / max(t.f - f_start, tiny_stress), Real(0)), Real(1));
  const auto s_yield = add(scale(1 - flow.elastic_part, t.s_old), flow.elastic_part, t.s_trial);
  const Real q_yield = deviatoric_stress(s_yield);
  const Real x =
      plastic_multiplier(t.q, t.shear_modulus, t.pressure.mean_stress * t.peak, m.given.k_p, in.eps_d);
  const Real back = min(Real(1.5) * t.shear_modulus * x / max(q_yield, tiny_stress), Real(1));
  flow.direction = add(t.s_trial, -back, s_yield);
  flow.q = deviatoric_stress(flow.direction);
  in.sin3theta = sin_3theta(flow.direction, flow.q);
  const Real cosine = Real(1.5) * contract(s_yield, flow.direction) / max(q_yield * flow.q, tiny_stress);
  flow.turn = select(q_yield > 0, max(2 * (1 - cosine), Real(0)), Real(0));
  return flow;
}

template <class Real, int N> Substep<Real, N> elastic_end(const Trial<Real, N>& t) {
  Substep<Real, N> out;
  out.point = {add_mean(t.s_trial, t.pressure.mean_stress), t.in.e_end, t.in.eps_d, 0};
  out.dissipation = 0;
  out.error = 0;
  out.plastic = out.nonconvex = Real(0) > Real(0);
  return out;
}

/// Plastic work per volume, on the yield surface all along: p (q/p + dilatancy), at mean values.
template <class Real> Real plastic_work(const Increment<Real>& in, const Candidate<Real>& end) {
  const Real M = (in.slopes_start.peak + end.slopes.peak) * Real(0.5);
  return max((in.start.mean_stress + end.pressure.mean_stress) * Real(0.5) *
                 (end.multiplier * M * end.mean_share + end.plastic_volumetric),
             Real(0));
}

/// Estimated error (20) of a plastic substep.
template <class Real, int N>
Real plastic_error(const MaterialOf<Real>& m, const Trial<Real, N>& t, const Flow<Real, N>& flow,
                   const Candidate<Real>& end) {
  const Increment<Real>& in = t.in;
  const Real x = end.multiplier, by_measure = 1 / (end.pressure.measure + m.floor_measure);
  const Real plastic_share =
      min(3 * end.shear_modulus * x / max(end.q_trial, Real(tiny<Scalar<Real>>)), Real(1));
  const Real slope_change = abs(end.slopes.transformation - in.slopes_start.transformation) +
                            abs(end.slopes.peak - in.slopes_start.peak);
  const Real growth = abs(end.pressure.measure - in.start.measure) * by_measure;
  const Real stiffer = abs(1 - t.shear_modulus / end.shear_modulus); // than the trial that gave the direction
  return sqrt(flow.turn) * (plastic_share * flow.turn * Real(0.35) + stiffer * Real(0.4)) +
         in.stiffening * by_measure *
             (x * m.given.A_d * slope_change / (2 * (1 - m.given.n)) +
              (4 * flow.elastic_part + Real(0.3)) * abs(end.plastic_volumetric) * growth);
}

/// Whether y, with a dilatancy that changes evenly over the substep, falls to a tenth of its lower end in between: the
/// point would lose its stress on the way.
template <class Real>
Mask<Real> dips(const MaterialOf<Real>& m, const Increment<Real>& in, const Candidate<Real>& end) {
  const Real x = end.multiplier, share = in.eps_d * in.inverse_start;
  const Real D_start = dilatancy(m, in.slopes_start.transformation, in.slopes_start.peak, share);
  const Real D_end = dilatancy(m, end.slopes.transformation, end.slopes.peak, end.share);
  const Real falls = x * D_start - in.volumetric, turns = x * (D_start - D_end);
  const Real room = in.start.measure - Real(0.1) * min(in.start.measure, end.pressure.measure);
  return (in.start.measure > 0) & (falls > 0) & (turns > falls) &
         (2 * turns * room < in.stiffening * falls * falls);
}

/// The point at the end that `solve` or `newton` found, at positive mean stress.
template <class Real, int N>
Substep<Real, N> plastic_end(const MaterialOf<Real>& m, const Trial<Real, N>& t, const Flow<Real, N>& flow,
                             const Candidate<Real>& end) {
  const Increment<Real>& in = t.in;
  const Real p = end.pressure.mean_stress, x = end.multiplier;
  Substep<Real, N> out;
  out.plastic = x > 0;
  out.nonconvex = out.plastic & !end.slopes.convex;
  const Real q = select(out.plastic, p * end.slopes.peak * end.share, end.q_trial); // (8)
  const Real factor = select(flow.q > 0, q / max(flow.q, Real(tiny<Scalar<Real>>)), Real(0));
  out.point = {add_mean(scale(factor, flow.direction), p), in.e_end, in.eps_d + x, 0};
  out.dissipation = plastic_work(in, end);
  out.error = select(dips(m, in, end), Real(1), plastic_error(m, t, flow, end));
  return out;
}

} // namespace simsand
