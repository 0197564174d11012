// SPDX-License-Identifier: BSD-3-Clause
// The functions of EQUATIONS.md, whose numbers stand at the lines. Compression positive; stress in the unit of
// p_at; strain without unit.
#pragma once
#include "vumat/parameters.hpp"
#include <algorithm>
#include <cmath>

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

template <class Real> Pressure<Real> pressure_of_mean_stress(const Material<Real>& m, Real mean_stress) {
  const Real ratio = std::max(mean_stress, Real(0)) / m.given.p_at;
  const Real log_ratio = std::log(std::max(ratio, m.floor_pressure));
  const Real w = std::exp((1 - m.given.n) * log_ratio);
  const bool floored = ratio < m.floor_pressure;
  const Real stiffness = floored ? m.floor_stiffness : ratio / w;
  const Real measure =
      floored ? ratio / stiffness : m.floor_measure + (w - m.floor_measure) / (1 - m.given.n);
  return {std::max(mean_stress, Real(0)), measure, stiffness, log_ratio};
}

template <class Real> Pressure<Real> pressure_of_measure(const Material<Real>& m, Real measure) {
  const Real above = std::max(measure - m.floor_measure, Real(0));
  const Real w = m.floor_measure + (1 - m.given.n) * above; // (p / p_at)^(1-n)
  const Real log_ratio = std::log(w) / (1 - m.given.n);
  const Real ratio = std::exp(log_ratio);
  const Real stiffness = above > 0 ? ratio / w : m.floor_stiffness;
  const Real mean_stress = m.given.p_at * (above > 0 ? ratio : measure * m.floor_stiffness);
  return {mean_stress, measure, stiffness, log_ratio};
}

/// (2.97 - e)^2 / (1 + e), the dependence of (1) on the void ratio.
template <class Real> Real void_ratio_factor(Real e) {
  const Real u = 1 + std::min(e, largest_elastic_void_ratio<Real>), d = Real(3.97) - u;
  return d * d / u;
}

/// Mean of the factor over a volumetric strain, from the void ratio at its middle (14): exact under (10).
template <class Real> Real mean_void_ratio_factor(Real e_middle, Real volumetric_strain) {
  const Real u = 1 + std::min(e_middle, largest_elastic_void_ratio<Real>);
  const Real t = Real(0.25) * volumetric_strain * volumetric_strain;
  const Real sinhc = 1 + t / 6 * (1 + t / 20 * (1 + t / 42));
  return (Real(3.97) * Real(3.97) / u + u) * sinhc - 2 * Real(3.97);
}

template <class Real> Real bulk_modulus(const Material<Real>& m, Real e, const Pressure<Real>& p) {
  return m.given.K0 * m.given.p_at * void_ratio_factor(e) * p.stiffness; // (1)
}

/// Void ratio after a volumetric strain, compression positive: 1 + e shrinks by its exponential (10).
template <class Real> Real void_ratio_after(Real e, Real volumetric_strain) {
  // (exp(x) - 1) = x / (1 - x/2 + x^2/12 - ...), relative error below x^8 / 1e6 for |x| < 0.3; reversible.
  const Real x = -volumetric_strain, t = x * x;
  const Real denominator = 1 - x / 2 + t / 12 * (1 - t / 60 * (1 - t / 42));
  return std::max(e + (1 + e) * x / denominator, smallest_void_ratio<Real>);
}

template <class Real> Real critical_void_ratio(const Material<Real>& m, Real log_ratio) {
  const Real e_c = m.given.e_ref - m.given.lambda * std::exp(m.given.zeta * log_ratio); // (3)
  return std::max(e_c, smallest_void_ratio<Real>);
}

/// Slope M of a friction angle given by its tangent, at a Lode angle.
template <class Real> struct Slope {
  Real value;
  bool convex; ///< c >= 0.611, an angle up to 46.5 degrees
};

/// (6) times (7) with c and the fractions cleared (18): 6 sin / (((3+sin)^4 (1+s) + (3-sin)^4 (1-s)) / 2)^(1/4),
/// s = sin 3theta, sin = tangent / r.
template <class Real> Slope<Real> slope(Real tangent, Real sin3theta) {
  const Real r = std::sqrt(1 + tangent * tangent), a = 3 * r - tangent, b = 3 * r + tangent;
  const Real a2 = a * a, b2 = b * b;
  const Real fourth = (b2 * b2 * (1 + sin3theta) + a2 * a2 * (1 - sin3theta)) / 2;
  return {6 * tangent / std::sqrt(std::sqrt(fourth)), a >= Real(0.611) * b};
}

/// exp of an exponent kept within +-15, which bounds every tangent and moves no sine by more than 1e-13.
template <class Real> Real bounded_exp(Real exponent) {
  return std::exp(std::min(std::max(exponent, Real(-15)), Real(15)));
}

/// ln (e_c / e): positive in dense sand.
template <class Real> Real denseness(const Material<Real>& m, Real e, const Pressure<Real>& p) {
  return std::log(critical_void_ratio(m, p.log_ratio) / e);
}

template <class Real> Slope<Real> peak_slope(const Material<Real>& m, Real denseness, Real sin3theta) {
  return slope(bounded_exp(m.given.n_p * denseness) * m.tan_phi, sin3theta); // (4)
}

template <class Real>
Slope<Real> transformation_slope(const Material<Real>& m, Real denseness, Real sin3theta) {
  return slope(bounded_exp(-m.given.n_d * denseness) * m.tan_phi, sin3theta); // (5)
}

/// M_p and M_pt of a void ratio and pressure, at a Lode angle.
template <class Real> struct Slopes {
  Real peak, transformation;
  bool convex; ///< of M_p
};

template <class Real>
Slopes<Real> slopes(const Material<Real>& m, Real e, const Pressure<Real>& p, Real sin3theta) {
  const Real dense = denseness(m, e, p);
  const auto peak = peak_slope(m, dense, sin3theta);
  return {peak.value, transformation_slope(m, dense, sin3theta).value, peak.convex};
}

/// Share of the peak strength that is mobilised, eps_d / (k_p + eps_d).
template <class Real> Real mobilised(const Material<Real>& m, Real eps_d) {
  return eps_d / (m.given.k_p + eps_d);
}

/// Mean of the mobilised share while eps_d grows by x (17); relative error of its complement below 1e-3 for
/// x <= k_p + eps_d.
template <class Real> Real mean_mobilised(const Material<Real>& m, Real eps_d, Real x) {
  const Real b = m.given.k_p + eps_d, z = x / b;
  return 1 - m.given.k_p / b * (6 + 3 * z) / (6 + z * (6 + z));
}

template <class Real> Real yield_function(Real q, Real p, Real M_p, Real share) {
  return q - p * M_p * share; // (8)
}

/// Plastic volumetric per deviatoric strain. Trap: the stress ratio is that of the yield surface, never that
/// of a trial stress, which has no bound as p goes to 0.
template <class Real> Real dilatancy(const Material<Real>& m, Real M_pt, Real M_p, Real share) {
  return m.given.A_d * (M_pt - M_p * share); // (9)
}

} // namespace simsand
