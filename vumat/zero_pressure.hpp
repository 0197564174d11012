// SPDX-License-Identifier: BSD-3-Clause
// Substeps of one point that start or end at zero pressure: EQUATIONS.md, "Separation" and "Zero pressure".
#pragma once
#include "vumat/end.hpp"

namespace simsand {

/// Elastic volumetric strain that takes a point of measure y to zero pressure: the integral of (1) along (10), solved by
/// Newton's rule from the tangent.
template <class T> T strain_to_zero_pressure(const Material<T>& m, T e, T measure) {
  T d = measure / (m.given.K0 * void_ratio_factor(e));
  for (int i = 0; i < 4; ++i) {
    const T used = m.given.K0 * d * mean_void_ratio_factor(void_ratio_after(e, -d / 2), d);
    d += (measure - used) / (m.given.K0 * void_ratio_factor(void_ratio_after(e, -d)));
  }
  return d;
}

/// The end of a point that lost its stress: what strain is left opens a gap.
template <class T, int N>
SubstepEnd<T, N> separated_end(const Material<T>& m, const SubstepInvariants<T>& in,
                               const EndCandidate<T>& end) {
  const T beyond =
      end.plastic_volumetric - in.volumetric - strain_to_zero_pressure(m, in.e_start, in.start.measure);
  const T gap = positive(beyond);
  return {
      {{}, in.e_end, in.eps_d + end.multiplier, gap}, plastic_work(in, end), 0, end.multiplier > 0, false};
}

/// Dilatancy on the yield surface as p goes to 0.
template <class T> T zero_pressure_dilatancy(const Material<T>& m, const Slopes<T>& M, T eps_d) {
  return dilatancy(m, M.transformation, M.peak, mobilised(m, eps_d));
}

/// Whether grains without pressure contract by shear, at first, more than they are compressed.
template <class T>
bool contracts_at_zero(const Material<T>& m, const SubstepInvariants<T>& in, const EndCandidate<T>& end) {
  return in.start.measure == 0 &&
         end.multiplier * zero_pressure_dilatancy(m, in.slopes_start, in.eps_d) > in.volumetric;
}

/// The end of such grains under compression: no gap opens, as shear takes up the compression, x D = d eps_v.
template <class T, int N>
SubstepEnd<T, N> contact_end(const Material<T>& m, const SubstepInvariants<T>& in,
                             const EndCandidate<T>& end) {
  const T D_start = zero_pressure_dilatancy(m, in.slopes_start, in.eps_d);
  const T x_start = in.volumetric / D_start;
  const T D_end = zero_pressure_dilatancy(m, end.slopes, in.eps_d + x_start);
  const T x = std::min(2 * in.volumetric / (D_start + std::max(D_end, T(0))), end.multiplier);
  return {{{}, in.e_end, in.eps_d + x, 0}, 0, 4 * std::abs(D_end / D_start - 1), true, false};
}

/// Whether plastic flow at vanishing pressure dilates by more than the strain extends, so that grains stay in contact.
template <class T>
bool dilates_at_zero(const Material<T>& m, const SubstepInvariants<T>& in, const EndCandidate<T>& end) {
  const T eps_d = in.eps_d + end.multiplier, M = end.slopes.peak * mobilised(m, eps_d);
  const T D = zero_pressure_dilatancy(m, end.slopes, eps_d);
  const T ratio = 3 * m.shear_ratio, shear = std::sqrt(T(2. / 3) * in.strain_norm); // 3 G / K
  const T x =
      (ratio * shear - M * in.volumetric) / (ratio - M * D); // df = 0 at p = 0, dp = K (d eps_v - x D)
  return x > 0 && in.volumetric > x * D;
}

} // namespace simsand
