// SPDX-License-Identifier: BSD-3-Clause
// The functions of EQUATIONS.md, whose numbers stand at the lines. Compression positive; stress in the unit of
// p_at; strain without unit.
#pragma once
#include "vumat/lane_functions.hpp"
#include "vumat/parameters.hpp"

namespace simsand {

/// Parameters with what depends on them alone.
template <class Real> struct Material {
  explicit Material(const Parameters<Real>& parameters);

  Parameters<Real> given;
  Real shear_ratio;     ///< G / K (2)
  Real tan_phi;         ///< critical state
  Real floor_pressure;  ///< p_min / p_at
  Real floor_stiffness; ///< (p_min / p_at)^n
  Real floor_measure;   ///< (p_min / p_at)^(1-n)
};

/// The material beside numbers or lanes of numbers.
template <class Real> using MaterialOf = Material<Scalar<Real>>;

/// Smallest void ratio, and smallest critical void ratio, that the equations see.
template <class Real> inline constexpr Real smallest_void_ratio = Real(0.01);
/// Largest void ratio that (1) sees; its factor vanishes at 2.97.
template <class Real> inline constexpr Real largest_elastic_void_ratio = Real(2);

/// What a mean stress means to the model. `measure` y orders pressures so that an elastic volumetric strain
/// de adds K0 g(e) de to it (12).
template <class Real> struct Pressure {
  Real mean_stress;
  Real measure;
  Real stiffness; ///< (p / p_at)^n, p not below p_min
  Real log_ratio; ///< ln (p / p_at), p not below p_min
};

/// ln (p / p_at), p not below p_min.
template <class Real> Real log_ratio_of_mean_stress(const MaterialOf<Real>& m, Real mean_stress) {
  return log(max(mean_stress * (1 / m.given.p_at), Real(m.floor_pressure)));
}

template <class Real>
Pressure<Real> pressure_of_mean_stress(const MaterialOf<Real>& m, Real mean_stress, Real log_ratio) {
  const Real ratio = max(mean_stress, Real(0)) * (1 / m.given.p_at);
  const Real w = exp((1 - m.given.n) * log_ratio);
  const Mask<Real> floored = ratio < m.floor_pressure;
  const Real stiffness = select(floored, Real(m.floor_stiffness), ratio / w);
  const Real measure = select(floored, ratio * (1 / m.floor_stiffness),
                              m.floor_measure + (w - m.floor_measure) * (1 / (1 - m.given.n)));
  return {max(mean_stress, Real(0)), measure, stiffness, log_ratio};
}

template <class Real> Pressure<Real> pressure_of_mean_stress(const MaterialOf<Real>& m, Real mean_stress) {
  return pressure_of_mean_stress(m, mean_stress, log_ratio_of_mean_stress(m, mean_stress));
}

/// (p / p_at)^(1-n), p not below p_min.
template <class Real> Real power_of_measure(const MaterialOf<Real>& m, Real measure) {
  return m.floor_measure + (1 - m.given.n) * max(measure - m.floor_measure, Real(0));
}

template <class Real> Real log_ratio_of_measure(const MaterialOf<Real>& m, Real measure) {
  return log(power_of_measure(m, measure)) * (1 / (1 - m.given.n));
}

template <class Real>
Pressure<Real> pressure_of_measure(const MaterialOf<Real>& m, Real measure, Real log_ratio) {
  const Real ratio = exp(log_ratio);
  const Mask<Real> over = measure > m.floor_measure;
  const Real stiffness = select(over, ratio / power_of_measure(m, measure), Real(m.floor_stiffness));
  const Real mean_stress = m.given.p_at * select(over, ratio, measure * m.floor_stiffness);
  return {mean_stress, measure, stiffness, log_ratio};
}

template <class Real> Pressure<Real> pressure_of_measure(const MaterialOf<Real>& m, Real measure) {
  return pressure_of_measure(m, measure, log_ratio_of_measure(m, measure));
}

/// Pressure after a change of measure, by series in the change of ln p: relative error below 2e-4 where that is
/// below 0.4, to rounding where below 1e-3. The measure moves by no more than half of (p / p_at)^(1-n) / (1-n).
template <class Real>
Pressure<Real> shifted(const MaterialOf<Real>& m, const Pressure<Real>& from, Real measure_change) {
  const Real w = power_of_measure(m, from.measure);
  const Real x = min(max((1 - m.given.n) * measure_change / w, Real(-0.5)), Real(0.5));
  const Real change = x * (1 - x * (Real(0.5) - x * (Real(1. / 3) - x * (Real(0.25) - x * Real(0.2))))) *
                      (1 / (1 - m.given.n));
  const Real a = m.given.n * change;
  const Real grown =
      from.stiffness * (1 + a * (1 + a * (Real(0.5) + a * (Real(1. / 6) + a * Real(1. / 24)))));
  const Real measure = from.measure + x * w * (1 / (1 - m.given.n));
  const Mask<Real> over = measure > m.floor_measure;
  const Real stiffness = select(over, grown, Real(m.floor_stiffness));
  const Real ratio = select(over, (1 + x) * w, measure) * stiffness;
  return {m.given.p_at * ratio, measure, stiffness, from.log_ratio + select(over, change, Real(0))};
}

/// (2.97 - e)^2 / (1 + e), the dependence of (1) on the void ratio.
template <class Real> Real void_ratio_factor(Real e) {
  const Real u = 1 + min(e, Real(largest_elastic_void_ratio<Scalar<Real>>)), d = Real(3.97) - u;
  return d * d / u;
}

/// Mean of the factor over a volumetric strain, from the void ratio at its middle (14): exact under (10).
template <class Real> Real mean_void_ratio_factor(Real e_middle, Real volumetric_strain) {
  const Real u = 1 + min(e_middle, Real(largest_elastic_void_ratio<Scalar<Real>>));
  const Real t = Real(0.25) * volumetric_strain * volumetric_strain;
  const Real sinhc = 1 + t * Real(1. / 6) * (1 + t * Real(1. / 20) * (1 + t * Real(1. / 42)));
  return (Real(3.97) * Real(3.97) / u + u) * sinhc - 2 * Real(3.97);
}

template <class Real> Real bulk_modulus(const MaterialOf<Real>& m, Real e, const Pressure<Real>& p) {
  return m.given.K0 * m.given.p_at * void_ratio_factor(e) * p.stiffness; // (1)
}

/// Volumetric strain up to which the void ratio follows a series.
template <class Real> inline constexpr Real largest_series_strain = Real(0.3125);

/// Void ratio after a volumetric strain, compression positive: 1 + e shrinks by its exponential (10). Lanes have it
/// up to the largest strain of the series.
template <class Real> Real void_ratio_after(Real e, Real volumetric_strain) {
  // (exp(x) - 1) = x / (1 - x/2 + x^2/12 - ...), relative error below x^8 / 1e6 for |x| < 0.3; reversible.
  const Real x = -volumetric_strain, t = x * x;
  if constexpr (std::is_floating_point_v<Real>)
    if (!(std::abs(x) <= largest_series_strain<Real>))
      return std::max(e + (1 + e) * std::expm1(x), smallest_void_ratio<Real>);
  const Real denominator =
      1 - x * Real(0.5) + t * Real(1. / 12) * (1 - t * Real(1. / 60) * (1 - t * Real(1. / 42)));
  return max(e + (1 + e) * x / denominator, Real(smallest_void_ratio<Scalar<Real>>));
}

template <class Real> Real critical_void_ratio(const MaterialOf<Real>& m, Real log_ratio) {
  const Real e_c = m.given.e_ref - m.given.lambda * exp(m.given.zeta * log_ratio); // (3)
  return max(e_c, Real(smallest_void_ratio<Scalar<Real>>));
}

/// Slope M of a friction angle given by its tangent, at a Lode angle.
template <class Real> struct Slope {
  Real value;
  Real rate;         ///< d ln M / d ln tangent
  Mask<Real> convex; ///< c >= 0.611, an angle up to 46.5 degrees
};

/// (6) times (7) with c and the fractions cleared (18): 6 sin / (((3+sin)^4 (1+s) + (3-sin)^4 (1-s)) / 2)^(1/4),
/// s = sin 3theta, sin = tangent / r.
template <class Real> Slope<Real> slope(Real tangent, Real sin3theta) {
  const Real r = sqrt(1 + tangent * tangent), a = 3 * r - tangent, b = 3 * r + tangent;
  const Real a2 = a * a, b2 = b * b, extension = 1 + sin3theta, compression = 1 - sin3theta;
  const Real fourth = (b2 * b2 * extension + a2 * a2 * compression) * Real(0.5);
  const Real inverse = 1 / sqrt(sqrt(fourth)), inverse2 = inverse * inverse, sine = tangent / r;
  const Real change = b2 * b * (3 * sine + 1) * extension + a2 * a * (3 * sine - 1) * compression;
  return {6 * tangent * inverse, 1 - Real(0.5) * tangent * change * inverse2 * inverse2,
          a >= Real(0.611) * b};
}

/// exp of an exponent kept within +-15, which bounds every tangent and moves no sine by more than 1e-13.
template <class Real> Real bounded_exp(Real exponent) {
  return exp(min(max(exponent, Real(-15)), Real(15)));
}

/// M_p and M_pt of a void ratio and pressure, at a Lode angle.
template <class Real> struct Slopes {
  Real peak, transformation;
  Mask<Real> convex; ///< of M_p
  Real peak_tangent, transformation_tangent;
  Real peak_rate, transformation_rate; ///< d ln M / d ln tangent
  Real density_change;                 ///< d ln e_c / d ln p above p_min
};

/// The same friction angles at another Lode angle.
template <class Real> Slopes<Real> at_angle(Slopes<Real> M, Real sin3theta) {
  const auto peak = slope(M.peak_tangent, sin3theta);
  M.peak = peak.value;
  M.convex = peak.convex;
  M.peak_rate = peak.rate;
  const auto transformation = slope(M.transformation_tangent, sin3theta);
  M.transformation = transformation.value;
  M.transformation_rate = transformation.rate;
  return M;
}

/// ln (e_c / e), positive in dense sand.
template <class Real> Real density(Real critical_void_ratio, Real e) {
  return log(critical_void_ratio / e);
}

template <class Real> Real peak_tangent(const MaterialOf<Real>& m, Real density) {
  return bounded_exp(m.given.n_p * density) * m.tan_phi; // (4)
}

/// Slopes but for the Lode angle.
template <class Real>
void set_tangents(const MaterialOf<Real>& m, Real critical_void_ratio, Real density, Slopes<Real>& M) {
  M.peak_tangent = peak_tangent(m, density);
  M.transformation_tangent = bounded_exp(-m.given.n_d * density) * m.tan_phi; // (5)
  M.density_change = select(critical_void_ratio > smallest_void_ratio<Scalar<Real>>,
                            m.given.zeta * (1 - m.given.e_ref / critical_void_ratio), Real(0));
}

template <class Real>
Slopes<Real> slopes(const MaterialOf<Real>& m, Real e, const Pressure<Real>& p, Real sin3theta) {
  const Real e_c = critical_void_ratio(m, p.log_ratio);
  Slopes<Real> M;
  set_tangents(m, e_c, density(e_c, e), M);
  return at_angle(M, sin3theta);
}

/// Largest change of ln (e_c / e) that `denser_by` sees: with n_p, n_d <= 20 tangents stay positive.
inline constexpr double largest_series_change = 0.04;

/// Slopes near enough for a first candidate, after a change of ln (e_c / e) and at another Lode angle.
template <class Real>
Slopes<Real> denser_by(const MaterialOf<Real>& m, Slopes<Real> M, Real change, Real sin3theta) {
  const Real bounded = min(max(change, Real(-largest_series_change)), Real(largest_series_change));
  M.peak_tangent = M.peak_tangent * (1 + m.given.n_p * bounded);
  M.transformation_tangent = M.transformation_tangent * (1 - m.given.n_d * bounded);
  return at_angle(M, sin3theta);
}

/// Slopes after a small change of ln p.
template <class Real> Slopes<Real> shifted(const MaterialOf<Real>& m, Slopes<Real> M, Real change) {
  const Real d = M.density_change * change;
  M.peak += m.given.n_p * d * M.peak * M.peak_rate;
  M.transformation += -m.given.n_d * d * M.transformation * M.transformation_rate;
  return M;
}

/// Share of the peak strength that is mobilised, eps_d / (k_p + eps_d).
template <class Real> Real mobilised(const MaterialOf<Real>& m, Real eps_d) {
  return eps_d / (m.given.k_p + eps_d);
}

/// Mean of the mobilised share while eps_d grows by x, of the inverse of k_p + eps_d at the start (17); relative error of its complement below 1e-3 for
/// x <= k_p + eps_d.
template <class Real> Real mean_mobilised(const MaterialOf<Real>& m, Real inverse, Real x) {
  const Real z = x * inverse;
  return 1 - m.given.k_p * inverse * (6 + 3 * z) / (6 + z * (6 + z));
}

template <class Real> Real yield_function(Real q, Real p, Real M_p, Real share) {
  return q - p * M_p * share; // (8)
}

/// Plastic volumetric per deviatoric strain. Trap: the stress ratio is that of the yield surface, never that
/// of a trial stress, which has no bound as p goes to 0.
template <class Real> Real dilatancy(const MaterialOf<Real>& m, Real M_pt, Real M_p, Real share) {
  return m.given.A_d * (M_pt - M_p * share); // (9)
}

} // namespace simsand
