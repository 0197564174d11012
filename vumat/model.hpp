// SPDX-License-Identifier: BSD-3-Clause
// SIMSAND: the functions of EQUATIONS.md, whose numbers stand at the lines. Compression positive; stress in the unit of
// p_at; strain without unit. All are templates on the number, one alone or lanes of them (lanes.hpp).
#pragma once
#include "vumat/elementary.hpp"
#include "vumat/parameters.hpp"

namespace simsand {

/// Parameters, and what depends on them alone.
template <class T> struct Material {
  explicit Material(const Parameters<T>& parameters);

  Parameters<T> given;
  T shear_ratio;     ///< G / K (2)
  T tan_phi;         ///< critical state
  T floor_pressure;  ///< p_min / p_at
  T floor_stiffness; ///< (p_min / p_at)^n
  T floor_measure;   ///< (p_min / p_at)^(1-n)
};

/// The material of one number or of lanes of it.
template <class Real> using MaterialOf = Material<Scalar<Real>>;

/// Smallest void ratio, and smallest critical void ratio, that the equations see.
inline constexpr double smallest_void_ratio = 0.01;
/// Largest void ratio that (1) sees: its factor vanishes at 2.97.
inline constexpr double largest_elastic_void_ratio = 2;

// ---- Mean stress and its measure y (12): an elastic volumetric strain d adds K0 g(e) d to y, whatever the stress.

template <class Real> struct Pressure {
  Real mean_stress; ///< p
  Real measure;     ///< y
  Real stiffness;   ///< (p / p_at)^n, p not below p_min
  Real log_ratio;   ///< ln (p / p_at), p not below p_min
};

template <class Real> Real log_ratio_of_mean_stress(const MaterialOf<Real>& m, Real p) {
  return log(at_least(p * (1 / m.given.p_at), m.floor_pressure));
}

template <class Real>
Pressure<Real> pressure_of_mean_stress(const MaterialOf<Real>& m, Real p, Real log_ratio) {
  const Real ratio = at_least(p, 0) * (1 / m.given.p_at), power = exp((1 - m.given.n) * log_ratio);
  const Real y = m.floor_measure + (power - m.floor_measure) * (1 / (1 - m.given.n)); // (12)
  const Mask<Real> below = ratio < m.floor_pressure;
  return {at_least(p, 0), select(below, ratio * (1 / m.floor_stiffness), y),
          select(below, m.floor_stiffness, ratio / power), log_ratio};
}

template <class Real> Pressure<Real> pressure_of_mean_stress(const MaterialOf<Real>& m, Real p) {
  return pressure_of_mean_stress(m, p, log_ratio_of_mean_stress(m, p));
}

/// (p / p_at)^(1-n), p not below p_min.
template <class Real> Real power_of_measure(const MaterialOf<Real>& m, Real y) {
  return m.floor_measure + (1 - m.given.n) * at_least(y - m.floor_measure, 0);
}

template <class Real> Real log_ratio_of_measure(const MaterialOf<Real>& m, Real y) {
  return log(power_of_measure(m, y)) * (1 / (1 - m.given.n));
}

template <class Real> Pressure<Real> pressure_of_measure(const MaterialOf<Real>& m, Real y, Real log_ratio) {
  const Real ratio = exp(log_ratio);
  const Mask<Real> above = y > m.floor_measure;
  const Real stiffness = select(above, ratio / power_of_measure(m, y), m.floor_stiffness);
  return {m.given.p_at * select(above, ratio, y * m.floor_stiffness), y, stiffness, log_ratio};
}

template <class Real> Pressure<Real> pressure_of_measure(const MaterialOf<Real>& m, Real y) {
  return pressure_of_measure(m, y, log_ratio_of_measure(m, y));
}

// ---- Elasticity.

/// g(e) = (2.97 - e)^2 / (1 + e), the dependence of (1) on the void ratio.
template <class Real> Real void_ratio_factor(Real e) {
  const Real u = 1 + at_most(e, largest_elastic_void_ratio), d = Real(3.97) - u;
  return d * d / u;
}

template <class Real> Real bulk_modulus(const MaterialOf<Real>& m, Real e, const Pressure<Real>& p) {
  return m.given.K0 * m.given.p_at * void_ratio_factor(e) * p.stiffness; // (1)
}

/// Volumetric strain up to which (10) follows a series.
inline constexpr double largest_series_strain = 0.3125;

/// Void ratio after a volumetric strain: 1 + e shrinks by its exponential (10). Lanes have it up to
/// `largest_series_strain`, one number for any strain.
template <class Real> Real void_ratio_after(Real e, Real volumetric_strain) {
  // (exp(x) - 1) = x / (1 - x/2 + x^2/12 - ...), relative error below x^8 / 1e6 for |x| < 0.3; reversible.
  const Real x = -volumetric_strain, t = x * x;
  if constexpr (is_one_number<Real>)
    if (!(std::abs(x) <= Real(largest_series_strain)))
      return at_least(e + (1 + e) * std::expm1(x), smallest_void_ratio);
  const Real denominator = 1 - x / 2 + t * Real(1. / 12) * (1 - t * Real(1. / 60) * (1 - t * Real(1. / 42)));
  return at_least(e + (1 + e) * x / denominator, smallest_void_ratio);
}

// ---- Critical state and friction.

template <class Real> Real critical_void_ratio(const MaterialOf<Real>& m, Real log_ratio) {
  return at_least(m.given.e_ref - m.given.lambda * exp(m.given.zeta * log_ratio), smallest_void_ratio); // (3)
}

/// ln (e_c / e), positive in dense sand.
template <class Real> Real log_state_ratio(Real critical_void_ratio, Real e) {
  return log(critical_void_ratio / e);
}

/// exp of an exponent kept within +-15, which bounds every tangent and moves no sine by more than 1e-13.
template <class Real> Real bounded_exp(Real exponent) {
  return exp(within(exponent, -15, 15));
}

template <class Real> Real peak_tangent(const MaterialOf<Real>& m, Real log_state_ratio) {
  return bounded_exp(m.given.n_p * log_state_ratio) * m.tan_phi; // (4)
}

template <class Real> Real transformation_tangent(const MaterialOf<Real>& m, Real log_state_ratio) {
  return bounded_exp(-m.given.n_d * log_state_ratio) * m.tan_phi; // (5)
}

/// Slope M of a friction angle at a Lode angle.
template <class Real> struct Slope {
  Real value;
  Real rate;         ///< d ln M / d ln tan phi
  Mask<Real> convex; ///< c >= 0.611, an angle up to 46.5 degrees
};

/// (6) times (7) with c and the fractions cleared (18): 6 sin / (((3+sin)^4 (1+s) + (3-sin)^4 (1-s)) / 2)^(1/4),
/// s = sin 3theta, sin = tangent / r.
template <class Real> Slope<Real> slope(Real tangent, Real sin3theta) {
  const Real r = sqrt(1 + tangent * tangent), a = 3 * r - tangent, b = 3 * r + tangent;
  const Real a2 = a * a, b2 = b * b, extension = 1 + sin3theta, compression = 1 - sin3theta;
  const Real fourth = (b2 * b2 * extension + a2 * a2 * compression) / 2;
  const Real inverse = 1 / sqrt(sqrt(fourth)), inverse2 = inverse * inverse, sine = tangent / r;
  const Real change = b2 * b * (3 * sine + 1) * extension + a2 * a * (3 * sine - 1) * compression;
  return {6 * tangent * inverse, 1 - tangent / 2 * change * inverse2 * inverse2, a >= Real(0.611) * b};
}

/// M_p and M_pt of a void ratio and pressure, at a Lode angle.
template <class Real> struct Slopes {
  Real peak, transformation;
  Mask<Real> convex; ///< of M_p
  Real peak_tangent, transformation_tangent;
  Real peak_rate, transformation_rate; ///< d ln M / d ln tan phi
  Real critical_rate;                  ///< d ln e_c / d ln p above p_min
};

/// Friction angles of a void ratio and pressure.
template <class Real>
void set_tangents(const MaterialOf<Real>& m, Real critical_void_ratio, Real log_state_ratio,
                  Slopes<Real>& M) {
  M.peak_tangent = peak_tangent(m, log_state_ratio);
  M.transformation_tangent = transformation_tangent(m, log_state_ratio);
  M.critical_rate = select(critical_void_ratio > Real(smallest_void_ratio),
                           m.given.zeta * (1 - m.given.e_ref / critical_void_ratio), Real(0));
}

/// The same friction angles at a Lode angle.
template <class Real> Slopes<Real> at_lode_angle(Slopes<Real> M, Real sin3theta) {
  const auto peak = slope(M.peak_tangent, sin3theta);
  M.peak = peak.value;
  M.convex = peak.convex;
  M.peak_rate = peak.rate;
  const auto transformation = slope(M.transformation_tangent, sin3theta);
  M.transformation = transformation.value;
  M.transformation_rate = transformation.rate;
  return M;
}

/// All of (3) to (7). Not inlined, so that the compiler fuses its products and sums alike for every caller.
template <class Real>
__attribute__((noinline)) Slopes<Real> slopes(const MaterialOf<Real>& m, Real e, const Pressure<Real>& p,
                                              Real sin3theta) {
  const Real e_c = critical_void_ratio(m, p.log_ratio);
  Slopes<Real> M;
  set_tangents(m, e_c, log_state_ratio(e_c, e), M);
  return at_lode_angle(M, sin3theta);
}

// ---- Yield and flow.

/// h, the share of the peak strength that is mobilised.
template <class Real> Real mobilised(const MaterialOf<Real>& m, Real eps_d) {
  return eps_d / (m.given.k_p + eps_d); // (8), (11)
}

template <class Real> Real yield_function(Real q, Real p, Real M_p, Real h) {
  return q - p * M_p * h; // (8)
}

/// Plastic volumetric per deviatoric strain. Its stress ratio is that of the yield surface, M_p h. That of a trial stress
/// has no bound as p goes to 0.
template <class Real> Real dilatancy(const MaterialOf<Real>& m, Real M_pt, Real M_p, Real h) {
  return m.given.A_d * (M_pt - M_p * h); // (9)
}

} // namespace simsand
