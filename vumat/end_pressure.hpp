// SPDX-License-Identifier: BSD-3-Clause
// The scalar problem of one substep: the mean stress at its end, sought as the measure y of (12). Every y has its
// multiplier in closed form from the yield condition; the volumetric strain (16) decides which y is right.
#pragma once
#include "vumat/functions.hpp"

namespace simsand {

/// Most evaluations of (16): with bisection, and of Newton's rule alone.
inline constexpr int largest_iteration_count = 100, largest_newton_count = 5;

/// Tolerance on the residual relative to y, and what rounding leaves of the terms that it sums.
template <class T> inline constexpr T tolerance = std::max(T(1e-12), 8 * std::numeric_limits<T>::epsilon());
template <class T> inline constexpr T rounding = 4 * std::numeric_limits<T>::epsilon();

/// Relative error of M that the last step by series may leave, and the largest change of ln p of such a step.
template <class T>
inline constexpr T series_error = std::max(T(1e-12), 4 * std::numeric_limits<T>::epsilon());
inline constexpr double largest_last_step = 1e-3;

/// What does not change while the mean stress at the end of the substep is sought.
template <class Real> struct Increment {
  Pressure<Real> start;
  Real e_start, e_end;
  Real volumetric;               ///< total volumetric strain
  Real stiffening;               ///< K0 times the mean void ratio factor: dy per elastic volumetric strain
  Real eps_d, inverse_start;     ///< at the start; of k_p + eps_d
  Real q_start;                  ///< of the deviator at the start
  Real stress_work, strain_norm; ///< s:de and de:de of the deviators
  Real sin3theta;                ///< of the deviator at the end
  Slopes<Real> slopes_start;
};

/// The end of a substep as far as one y decides it.
template <class Real> struct Candidate {
  Pressure<Real> pressure;
  Slopes<Real> slopes;
  Real shear_modulus; ///< mean over the substep
  Real q_trial;
  Real multiplier;
  Real inverse;            ///< of k_p + eps_d
  Real share;              ///< mobilised at the end
  Real mean_share;         ///< mobilised on average
  Real plastic_volumetric; ///< multiplier times mean dilatancy
  Real residual;           ///< of (16)
};

/// Change of y, over y, below which the mean of both ends stands for dp / dy, whose differences rounding eats; it is
/// wrong by about a tenth of the square of that for n = 1/2 to 2/3, and to first order where p_min lies in between.
template <class T> inline constexpr T smallest_difference = sizeof(T) == 8 ? T(1e-3) : T(2e-2);

/// Mean of p^n over a substep in which y changes evenly (13), by (12) dp / dy.
template <class Real>
Real mean_stiffness(const MaterialOf<Real>& m, const Pressure<Real>& a, const Pressure<Real>& b) {
  const Real change = b.measure - a.measure;
  const Mask<Real> large = abs(change) > smallest_difference<Scalar<Real>> * (b.measure + m.floor_measure);
  const Real secant = (b.mean_stress - a.mean_stress) / (m.given.p_at * select(large, change, Real(1)));
  return select(large, secant, (a.stiffness + b.stiffness) * Real(0.5));
}

template <class Real>
Real mean_shear_modulus(const MaterialOf<Real>& m, const Increment<Real>& in, const Pressure<Real>& end) {
  return m.shear_ratio * m.given.p_at * in.stiffening * mean_stiffness(m, in.start, end);
}

/// Non-negative x with q_trial - 3 G x = B (eps_d + x) / (k_p + eps_d + x); 0 inside the yield surface (15).
template <class Real> Real plastic_multiplier(Real q_trial, Real G, Real B, Scalar<Real> k_p, Real eps_d) {
  const Real b = 3 * G * (k_p + eps_d) - q_trial + B, c = q_trial * (k_p + eps_d) - B * eps_d;
  const Real root = sqrt(max(b * b + 12 * G * c, Real(0)));
  const Mask<Real> positive = b > 0;
  const Real x = select(positive, 2 * c, root - b) / select(positive, b + root, 6 * G);
  return select(c <= 0, Real(0), x);
}

/// All that follows from a pressure at the end of the substep and the slopes there.
template <class Real>
void evaluate(const MaterialOf<Real>& m, const Increment<Real>& in, Candidate<Real>& c) {
  const Real p = c.pressure.mean_stress;
  const Real G = c.shear_modulus = mean_shear_modulus(m, in, c.pressure);
  c.q_trial = sqrt(max(in.q_start * in.q_start + 6 * G * (in.stress_work + G * in.strain_norm), Real(0)));
  const Real x = c.multiplier = plastic_multiplier(c.q_trial, G, p * c.slopes.peak, m.given.k_p, in.eps_d);
  const Real eps_d = in.eps_d + x;
  c.inverse = 1 / (m.given.k_p + eps_d);
  c.share = eps_d * c.inverse;
  c.mean_share = mean_mobilised(m, in.inverse_start, x);
  c.plastic_volumetric =
      x * dilatancy(m, (in.slopes_start.transformation + c.slopes.transformation) * Real(0.5),
                    (in.slopes_start.peak + c.slopes.peak) * Real(0.5), c.mean_share);
  c.residual = c.pressure.measure - in.start.measure - in.stiffening * (in.volumetric - c.plastic_volumetric);
}

template <class Real>
Candidate<Real> candidate(const MaterialOf<Real>& m, const Increment<Real>& in, const Pressure<Real>& end,
                          const Slopes<Real>& at_end) {
  Candidate<Real> c;
  c.pressure = end;
  c.slopes = at_end;
  evaluate(m, in, c);
  return c;
}

template <class Real>
Candidate<Real> candidate(const MaterialOf<Real>& m, const Increment<Real>& in, const Pressure<Real>& end) {
  return candidate(m, in, end, slopes(m, in.e_end, end, in.sin3theta));
}

/// d residual / d y.
template <class Real>
Real residual_slope(const MaterialOf<Real>& m, const Increment<Real>& in, const Candidate<Real>& c) {
  const Real p = c.pressure.mean_stress, G = c.shear_modulus, M_p = c.slopes.peak,
             M_pt = c.slopes.transformation;
  const Real hardening = p * M_p * m.given.k_p * c.inverse * c.inverse;
  const Real p_dM_p = m.given.n_p * M_p * c.slopes.peak_rate * c.slopes.density_change;
  const Real p_dM_pt = -m.given.n_d * M_pt * c.slopes.transformation_rate * c.slopes.density_change;
  // p dG / dp times dq/dG of the trial less 3x: what a stiffer point gains of q.
  const Real p_dG =
      Real(0.5) * m.given.n * m.shear_ratio * m.given.p_at * in.stiffening * c.pressure.stiffness;
  const Real dq_dG =
      3 * (in.stress_work + 2 * G * in.strain_norm) / max(c.q_trial, Real(tiny<Scalar<Real>>)) -
      3 * c.multiplier;
  const Real p_dx = (p_dG * dq_dG - p * (M_p + p_dM_p) * c.share) / (3 * G + hardening);
  const Real D = dilatancy(m, (in.slopes_start.transformation + M_pt) * Real(0.5),
                           (in.slopes_start.peak + M_p) * Real(0.5), c.share);
  const Real p_dD = Real(0.5) * m.given.A_d * (p_dM_pt - p_dM_p * c.mean_share);
  const Real y_dy = m.given.p_at * c.pressure.stiffness / max(p, Real(tiny<Scalar<Real>>));
  const Real slope =
      1 + select(c.multiplier > 0, in.stiffening * (D * p_dx + c.multiplier * p_dD) * y_dy, Real(0));
  return max(slope, Real(0.1));
}

/// Largest multiplier, that of a vanishing stress at the end.
template <class Real> Real largest_multiplier(const MaterialOf<Real>& m, const Increment<Real>& in) {
  const Real G_least =
      (1 - m.given.n) / 2 * m.shear_ratio * m.given.p_at * in.stiffening * in.start.stiffness;
  return sqrt(Real(2. / 3) * in.strain_norm) + in.q_start / (3 * G_least);
}

/// Whether a candidate solves (16).
template <class Real>
Mask<Real> solved(const MaterialOf<Real>& m, const Increment<Real>& in, const Candidate<Real>& c,
                  Real x_most) {
  const Real terms = in.start.measure + in.stiffening * (abs(in.volumetric) + m.given.A_d * x_most);
  return abs(c.residual) <=
         tolerance<Scalar<Real>> * (c.pressure.measure + m.floor_measure) + rounding<Scalar<Real>> * terms;
}

/// The change of measure by Newton's rule.
template <class Real>
Real newton_step(const MaterialOf<Real>& m, const Increment<Real>& in, const Candidate<Real>& c) {
  return -c.residual / residual_slope(m, in, c);
}

/// Pressure and slopes after a change of measure, by series from where they are.
template <class Real>
void shift(const MaterialOf<Real>& m, const Candidate<Real>& from, Real measure_step, Candidate<Real>& to) {
  const Real log_ratio = from.pressure.log_ratio;
  to.pressure = shifted(m, from.pressure, measure_step);
  to.slopes = shifted(m, from.slopes, to.pressure.log_ratio - log_ratio);
}

/// A guess of the end: the start, or the trial where that compresses much; with slopes near enough.
template <class Real>
void first_candidate(const MaterialOf<Real>& m, const Increment<Real>& in, const Pressure<Real>& trial,
                     Candidate<Real>& c) {
  const Mask<Real> compressed = trial.measure > 2 * in.start.measure;
  c.pressure.mean_stress = select(compressed, trial.mean_stress, in.start.mean_stress);
  c.pressure.measure = select(compressed, trial.measure, in.start.measure);
  c.pressure.stiffness = select(compressed, trial.stiffness, in.start.stiffness);
  c.pressure.log_ratio = select(compressed, trial.log_ratio, in.start.log_ratio);
  const Real denser = 2 * (in.e_start - in.e_end) / (in.e_start + in.e_end) +
                      in.slopes_start.density_change * (c.pressure.log_ratio - in.start.log_ratio);
  c.slopes = denser_by(m, in.slopes_start, denser, in.sin3theta);
}

/// Whether a step by series is short enough: what it leaves out of M grows with the square of the change.
template <class Real>
Mask<Real> short_step(const MaterialOf<Real>& m, const Candidate<Real>& from, const Candidate<Real>& to) {
  const Real change = abs(to.pressure.log_ratio - from.pressure.log_ratio);
  const Real rate = std::max(m.given.n_p, m.given.n_d) * abs(from.slopes.density_change);
  const Real left_out = change * change * rate * (1 + rate);
  return (left_out <= Real(series_error<Scalar<Real>>)) & (change <= Real(largest_last_step));
}

/// Solves residual(y) = 0 from a first candidate: Newton, then secants, kept inside a bracket by bisection.
/// An end at y = 0 with a positive residual is a point that has parted.
template <class Real>
Candidate<Real> solve(const Material<Real>& m, const Increment<Real>& in, Candidate<Real> c,
                      bool& converged) {
  // No y above `high`: no dilatancy exceeds 3 A_d.
  const Real x_most = largest_multiplier(m, in);
  Real low = 0, high = in.start.measure +
                       in.stiffening * (std::max(in.volumetric, Real(0)) + 3 * m.given.A_d * x_most);
  bool low_known = false, stalled = false;
  Real slope = residual_slope(m, in, c);
  for (int i = 0; i < largest_iteration_count; ++i) {
    const Real y = c.pressure.measure;
    if (solved(m, in, c, x_most) || (y == 0 && c.residual > 0)) return c;
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
  converged = solved(m, in, c, x_most);
  return c;
}

} // namespace simsand
