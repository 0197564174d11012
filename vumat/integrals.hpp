// SPDX-License-Identifier: BSD-3-Clause
// Means of the model's functions over a substep, and the model after a small change by series: EQUATIONS.md, "Update".
#pragma once
#include "vumat/model.hpp"

namespace simsand {

/// Mean of g(e) over a volumetric strain, from the void ratio at its middle (14): exact under (10).
template <class Real> Real mean_void_ratio_factor(Real e_middle, Real volumetric_strain) {
  const Real u = 1 + at_most(e_middle, largest_elastic_void_ratio);
  const Real t = Real(0.25) * volumetric_strain * volumetric_strain;
  const Real sinhc = 1 + t * Real(1. / 6) * (1 + t * Real(1. / 20) * (1 + t * Real(1. / 42)));
  return (Real(3.97) * Real(3.97) / u + u) * sinhc - 2 * Real(3.97);
}

/// Relative change of y below which the mean of both ends stands for dp / dy, as the difference of nearly equal numbers
/// has too few digits. It is wrong by about a tenth of the square of that for n = 1/2 to 2/3, and to first order where
/// p_min lies in between.
template <class T> inline constexpr T smallest_difference = sizeof(T) == 8 ? T(1e-3) : T(2e-2);

/// Mean of (p / p_at)^n over a substep in which y changes evenly (13): dp / dy by (12).
template <class Real>
Real mean_stiffness(const MaterialOf<Real>& m, const Pressure<Real>& a, const Pressure<Real>& b) {
  const Real change = b.measure - a.measure;
  const Mask<Real> large = abs(change) > smallest_difference<Scalar<Real>> * (b.measure + m.floor_measure);
  const Real secant = (b.mean_stress - a.mean_stress) / (m.given.p_at * select(large, change, Real(1)));
  return select(large, secant, (a.stiffness + b.stiffness) / 2);
}

/// Mean of h while eps_d grows by x, of `inverse` = 1 / (k_p + eps_d) at the start (17). Relative error of 1 - h below
/// 1e-3 for x <= k_p + eps_d.
template <class Real> Real mean_mobilised(const MaterialOf<Real>& m, Real inverse, Real x) {
  const Real z = x * inverse;
  return 1 - m.given.k_p * inverse * (6 + 3 * z) / (6 + z * (6 + z));
}

/// Pressure after a change of y, by series in the change of ln p: relative error below 2e-4 where that is below 0.4, to
/// rounding where it is below 1e-3. y moves by no more than half of (p / p_at)^(1-n) / (1-n).
template <class Real>
Pressure<Real> shifted(const MaterialOf<Real>& m, const Pressure<Real>& from, Real measure_change) {
  const Real w = power_of_measure(m, from.measure);
  const Real x = within((1 - m.given.n) * measure_change / w, -0.5, 0.5);
  const Real change = x * (1 - x * (Real(0.5) - x * (Real(1. / 3) - x * (Real(0.25) - x * Real(0.2))))) *
                      (1 / (1 - m.given.n));
  const Real a = m.given.n * change;
  const Real grown =
      from.stiffness * (1 + a * (1 + a * (Real(0.5) + a * (Real(1. / 6) + a * Real(1. / 24)))));
  const Real y = from.measure + x * w * (1 / (1 - m.given.n));
  const Mask<Real> above = y > m.floor_measure;
  const Real stiffness = select(above, grown, Real(m.floor_stiffness));
  const Real ratio = select(above, (1 + x) * w, y) * stiffness;
  return {m.given.p_at * ratio, y, stiffness, from.log_ratio + select(above, change, Real(0))};
}

/// Slopes after a small change of ln p.
template <class Real> Slopes<Real> shifted(const MaterialOf<Real>& m, Slopes<Real> M, Real change) {
  const Real d = M.critical_rate * change;
  M.peak += m.given.n_p * d * M.peak * M.peak_rate;
  M.transformation += -m.given.n_d * d * M.transformation * M.transformation_rate;
  return M;
}

/// Largest change of ln (e_c / e) that `roughly_shifted` sees: with n_p, n_d <= 20 tangents stay positive.
inline constexpr double largest_linear_change = 0.04;

/// Slopes near enough for a first guess, after a change of ln (e_c / e) and at another Lode angle.
template <class Real>
Slopes<Real> roughly_shifted(const MaterialOf<Real>& m, Slopes<Real> M, Real change, Real sin3theta) {
  const Real bounded = within(change, -largest_linear_change, largest_linear_change);
  M.peak_tangent = M.peak_tangent * (1 + m.given.n_p * bounded);
  M.transformation_tangent = M.transformation_tangent * (1 - m.given.n_d * bounded);
  return at_lode_angle(M, sin3theta);
}

} // namespace simsand
