// SPDX-License-Identifier: BSD-3-Clause
// The scalar problem of one substep: the mean stress at its end, sought as the measure y of (12). Every y has its
// multiplier in closed form from the yield condition; the volumetric strain (16) decides which y is right.
#pragma once
#include "vumat/functions.hpp"
#include <limits>

namespace simsand {

inline constexpr int largest_iteration_count = 100;

/// Tolerance on the residual relative to y, and what rounding leaves of the terms that it sums.
template <class Real>
inline constexpr Real tolerance = std::max(Real(1e-10), 8 * std::numeric_limits<Real>::epsilon());
template <class Real> inline constexpr Real rounding = 4 * std::numeric_limits<Real>::epsilon();

/// What does not change while the mean stress at the end of the substep is sought.
template <class Real> struct Increment {
  Pressure<Real> start;
  Real e_start, e_end;
  Real volumetric;               ///< total volumetric strain
  Real stiffening;               ///< K0 times the mean void ratio factor: dy per elastic volumetric strain
  Real eps_d;                    ///< at the start
  Real q_start;                  ///< of the deviator at the start
  Real stress_work, strain_norm; ///< s:de and de:de of the deviators
  Real sin3theta;                ///< of the elastic trial
  Slopes<Real> slopes_start;
};

/// The end of a substep as far as one y decides it.
template <class Real> struct Candidate {
  Pressure<Real> pressure;
  Slopes<Real> slopes;
  Real shear_modulus; ///< mean over the substep
  Real q_trial;
  Real multiplier;
  Real share;              ///< mobilised at the end
  Real mean_share;         ///< mobilised on average
  Real plastic_volumetric; ///< multiplier times mean dilatancy
  Real residual;           ///< of (16)
};

/// Mean of p^n over a substep (13): trapezoidal in y, exact for n = 1/2.
template <class Real> Real mean_stiffness(const Pressure<Real>& a, const Pressure<Real>& b) {
  return (a.stiffness + b.stiffness) / 2;
}

/// Relative error of that mean, to leading order and no smaller for n > 1/3.
template <class Real>
Real mean_stiffness_error(const Material<Real>& m, const Pressure<Real>& a, const Pressure<Real>& b) {
  const Real change = (b.stiffness - a.stiffness) / (b.stiffness + a.stiffness);
  return std::abs(2 * m.given.n - 1) * change * change;
}

template <class Real>
Real mean_shear_modulus(const Material<Real>& m, const Increment<Real>& in, const Pressure<Real>& end) {
  return m.shear_ratio * m.given.p_at * in.stiffening * mean_stiffness(in.start, end);
}

/// Non-negative x with q_trial - 3 G x = B (eps_d + x) / (k_p + eps_d + x); 0 inside the yield surface (15).
template <class Real> Real plastic_multiplier(Real q_trial, Real G, Real B, Real k_p, Real eps_d) {
  const Real b = 3 * G * (k_p + eps_d) - q_trial + B, c = q_trial * (k_p + eps_d) - B * eps_d;
  if (c <= 0) return 0;
  const Real root = std::sqrt(b * b + 12 * G * c);
  return b > 0 ? 2 * c / (b + root) : (root - b) / (6 * G);
}

/// All that follows from a pressure at the end of the substep.
template <class Real>
Candidate<Real> candidate(const Material<Real>& m, const Increment<Real>& in, const Pressure<Real>& end) {
  Candidate<Real> c;
  c.pressure = end;
  c.slopes = slopes(m, in.e_end, end, in.sin3theta);
  const Real G = c.shear_modulus = mean_shear_modulus(m, in, end);
  c.q_trial =
      std::sqrt(std::max(in.q_start * in.q_start + 6 * G * (in.stress_work + G * in.strain_norm), Real(0)));
  c.multiplier = plastic_multiplier(c.q_trial, G, end.mean_stress * c.slopes.peak, m.given.k_p, in.eps_d);
  c.share = mobilised(m, in.eps_d + c.multiplier);
  c.mean_share = mean_mobilised(m, in.eps_d, c.multiplier);
  c.plastic_volumetric =
      c.multiplier * dilatancy(m, (in.slopes_start.transformation + c.slopes.transformation) / 2,
                               (in.slopes_start.peak + c.slopes.peak) / 2, c.mean_share);
  c.residual = end.measure - in.start.measure - in.stiffening * (in.volumetric - c.plastic_volumetric);
  return c;
}

/// d residual / d y with the slopes M held.
template <class Real>
Real residual_slope(const Material<Real>& m, const Increment<Real>& in, const Candidate<Real>& c) {
  const Real b = m.given.k_p + in.eps_d + c.multiplier;
  const Real hardening = c.pressure.mean_stress * c.slopes.peak * m.given.k_p / (b * b);
  const Real dx_dp = -c.slopes.peak * c.share / (3 * c.shear_modulus + hardening);
  const Real D = dilatancy(m, c.slopes.transformation, c.slopes.peak, c.share);
  const Real slope = 1 + in.stiffening * D * dx_dp * m.given.p_at * c.pressure.stiffness;
  return std::max(slope, Real(0.1));
}

/// Solves residual(y) = 0 from a first candidate: Newton, then secants, kept inside a bracket by bisection.
/// An end at y = 0 with a positive residual is a point that has parted.
template <class Real>
Candidate<Real> solve(const Material<Real>& m, const Increment<Real>& in, Candidate<Real> c,
                      bool& converged) {
  // No y above `high`: the largest multiplier is that of a vanishing end stress, no dilatancy exceeds 3 A_d.
  const Real G_least =
      (1 - m.given.n) / 2 * m.shear_ratio * m.given.p_at * in.stiffening * in.start.stiffness;
  const Real x_most = std::sqrt(Real(2) / 3 * in.strain_norm) + in.q_start / (3 * G_least);
  const Real terms = in.start.measure + in.stiffening * (std::abs(in.volumetric) + m.given.A_d * x_most);
  const auto small = [&](const Candidate<Real>& x) {
    return std::abs(x.residual) <=
           tolerance<Real> * (x.pressure.measure + m.floor_measure) + rounding<Real> * terms;
  };
  Real low = 0, high = in.start.measure +
                       in.stiffening * (std::max(in.volumetric, Real(0)) + 3 * m.given.A_d * x_most);
  bool low_known = false, stalled = false;
  Real slope = residual_slope(m, in, c);
  for (int i = 0; i < largest_iteration_count; ++i) {
    const Real y = c.pressure.measure;
    if (small(c) || (y == 0 && c.residual > 0)) return c;
    if (c.residual > 0) {
      high = y;
    } else {
      low = y;
      low_known = true;
    }
    Real next = y - c.residual / slope;
    if (!low_known && next <= 0) {
      next = 0;
    } else if (!(next > low && next < high) || stalled) {
      next = (low + high) / 2;
    }
    const Candidate<Real> d = candidate(m, in, pressure_of_measure(m, next));
    const Real secant = (d.residual - c.residual) / (next - y);
    stalled = !stalled && std::abs(d.residual) > std::abs(c.residual) / 2;
    slope = secant > 0 ? secant : residual_slope(m, in, d);
    c = d;
  }
  converged = small(c);
  return c;
}

} // namespace simsand
