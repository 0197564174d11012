// SPDX-License-Identifier: BSD-3-Clause
// The end of a substep and its estimated error: EQUATIONS.md, "Update" and "Substeps".
#pragma once
#include "vumat/solve.hpp"

namespace simsand {

template <class Real, int N> SubstepEnd<Real, N> elastic_end(const SubstepWorkspace<Real, N>& w) {
  SubstepEnd<Real, N> out;
  out.state = {add_mean(w.trial.s_trial, w.trial.pressure.mean_stress), w.in.e_end, w.in.eps_d, 0};
  out.dissipation = 0;
  out.error = 0;
  out.plastic = out.nonconvex = Real(0) > Real(0);
  return out;
}

/// Plastic work per volume, on the yield surface all along: p (q/p + dilatancy), at mean values.
template <class Real> Real plastic_work(const SubstepInvariants<Real>& in, const EndCandidate<Real>& end) {
  const Real M = (in.slopes_start.peak + end.slopes.peak) / 2;
  return at_least((in.start.mean_stress + end.pressure.mean_stress) / 2 *
                      (end.multiplier * M * end.mean_mobilised + end.plastic_volumetric),
                  0);
}

/// Error up to which the shortest substep is accepted: where p is about to vanish the estimate, relative to p, is large and
/// does not matter.
inline constexpr double largest_error = 4;

/// Estimated error (20) of a plastic substep.
template <class Real, int N>
Real plastic_error(const MaterialOf<Real>& m, const SubstepWorkspace<Real, N>& w) {
  const auto& in = w.in;
  const auto& end = w.end;
  const Real x = end.multiplier, by_measure = 1 / (end.pressure.measure + m.floor_measure);
  const Real plastic_share = at_most(3 * end.shear_modulus * x / positive(end.q_trial), 1);
  const Real slope_change = abs(end.slopes.transformation - in.slopes_start.transformation) +
                            abs(end.slopes.peak - in.slopes_start.peak);
  const Real growth = abs(end.pressure.measure - in.start.measure) * by_measure;
  const Real stiffer =
      abs(1 - w.trial.shear_modulus / end.shear_modulus); // than the trial that gave the direction
  return sqrt(w.flow.turn) * (plastic_share * w.flow.turn * Real(0.35) + stiffer * Real(0.4)) +
         in.bulk_factor * by_measure *
             (x * m.given.A_d * slope_change / (2 * (1 - m.given.n)) +
              (4 * w.flow.elastic_part + Real(0.3)) * abs(end.plastic_volumetric) * growth);
}

/// Whether y, with a dilatancy that changes evenly over the substep, falls to a tenth of its lower end in between: the
/// point would lose its stress on the way.
template <class Real>
Mask<Real> loses_stress_on_the_way(const MaterialOf<Real>& m, const SubstepInvariants<Real>& in,
                                   const EndCandidate<Real>& end) {
  const Real x = end.multiplier, h_start = in.eps_d * in.inverse_start;
  const Real D_start = dilatancy(m, in.slopes_start.transformation, in.slopes_start.peak, h_start);
  const Real D_end = dilatancy(m, end.slopes.transformation, end.slopes.peak, end.mobilised);
  const Real falls = x * D_start - in.volumetric, turns = x * (D_start - D_end);
  const Real allowed = in.start.measure - Real(0.1) * min(in.start.measure, end.pressure.measure);
  return (in.start.measure > 0) & (falls > 0) & (turns > falls) &
         (2 * turns * allowed < in.bulk_factor * falls * falls);
}

/// The end at a positive mean stress that solves (16).
template <class Real, int N>
SubstepEnd<Real, N> plastic_end(const MaterialOf<Real>& m, const SubstepWorkspace<Real, N>& w) {
  const auto& flow = w.flow;
  const auto& end = w.end;
  const Real p = end.pressure.mean_stress, x = end.multiplier;
  SubstepEnd<Real, N> out;
  out.plastic = x > 0;
  out.nonconvex = out.plastic & !end.slopes.convex;
  const Real q = select(out.plastic, p * end.slopes.peak * end.mobilised, end.q_trial); // (8)
  const Real factor = select(flow.q > 0, q / positive(flow.q), Real(0));
  out.state = {add_mean(scale(factor, flow.deviator), p), w.in.e_end, w.in.eps_d + x, 0};
  out.dissipation = plastic_work(w.in, end);
  // Shorter substeps do not shorten the return of a stress from beyond the yield surface.
  const Mask<Real> outside = w.flow.f_start > Real(1e-3) * w.in.start.mean_stress;
  // A multiplier of 0 beside a stress beyond the yield surface: numbers too large for their precision.
  const Mask<Real> sound = out.plastic | (q <= p * end.slopes.peak * end.mobilised + Real(1e-3) * p);
  out.error = select(loses_stress_on_the_way(m, w.in, end), Real(1), plastic_error(m, w));
  out.error = select(outside, at_most(out.error, largest_error), out.error);
  out.error = select(sound, out.error, Real(std::numeric_limits<Scalar<Real>>::max()));
  return out;
}

} // namespace simsand
