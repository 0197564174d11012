// SPDX-License-Identifier: BSD-3-Clause
// The stress update: EQUATIONS.md, section "Update". One substep is a scalar problem in the measure y of the
// mean stress at its end; the yield condition gives the multiplier of each y in closed form.
#include "vumat/simsand.hpp"
#include "vumat/end_pressure.hpp"

namespace simsand {
namespace {

/// Accepted error of a substep relative to the mean stress, of the first-order companion of the update.
constexpr double substep_tolerance = 0.05;
/// Substeps are counted in ticks; an increment is so many, the smallest substep is one.
constexpr int ticks_per_increment = 1024;
/// Contraction alone may empty a point of its stress only in substeps as short as this.
constexpr int ticks_of_collapse = ticks_per_increment / 16;

template <class Real, int N> struct Substep {
  Point<Real, N> point;
  Real dissipation = 0;
  Real error = 0;
  bool plastic = false, nonconvex = false;
  bool converged = true;
  bool collapsed = false; ///< p reached 0 by contraction, not by extension
};

/// Elastic volumetric strain that takes a point of measure y to zero pressure: the integral of (1) along (10)
/// solved by Newton's rule, which squares the error, from the tangent.
template <class Real> Real strain_to_zero_pressure(const Material<Real>& m, Real e, Real measure) {
  Real d = measure / (m.given.K0 * void_ratio_factor(e));
  for (int i = 0; i < 4; ++i) {
    const Real used = m.given.K0 * d * mean_void_ratio_factor(void_ratio_after(e, -d / 2), d);
    d += (measure - used) / (m.given.K0 * void_ratio_factor(void_ratio_after(e, -d)));
  }
  return d;
}

/// One substep of a point that carries stress or is about to.
template <class Real, int N>
Substep<Real, N> stressed_substep(const Material<Real>& m, const Point<Real, N>& old,
                                  const SymmetricTensor<Real, N>& strain) {
  const Real p_old = trace(old.stress) / 3;
  const auto s_old = scale(p_old > 0 ? Real(1) : Real(0), deviator(old.stress)); // none outlives p = 0
  const auto e_dev = deviator(strain);
  Increment<Real> in;
  in.start = pressure_of_mean_stress(m, p_old);
  in.volumetric = trace(strain);
  in.e_start = old.void_ratio;
  const Real e_middle = void_ratio_after(old.void_ratio, in.volumetric / 2);
  in.e_end = void_ratio_after(e_middle, in.volumetric / 2);
  in.stiffening = m.given.K0 * mean_void_ratio_factor(e_middle, in.volumetric);
  in.eps_d = old.plastic_strain;
  in.q_start = deviatoric_stress(s_old);
  in.stress_work = contract(s_old, e_dev);
  in.strain_norm = contract(e_dev, e_dev);

  const Real y_trial = in.start.measure + in.stiffening * in.volumetric;
  const auto trial = pressure_of_measure(m, std::max(y_trial, Real(0)));
  const auto s_trial = add(s_old, 2 * mean_shear_modulus(m, in, trial), e_dev);
  const Real q_trial = deviatoric_stress(s_trial);
  in.sin3theta = sin_3theta(s_trial, q_trial);

  Substep<Real, N> out;
  out.point.void_ratio = in.e_end;
  out.error = mean_stiffness_error(m, in.start, trial);
  const Real M_trial = peak_slope(m, denseness(m, in.e_end, trial), in.sin3theta).value;
  const Real f_trial = yield_function(q_trial, trial.mean_stress, M_trial, mobilised(m, in.eps_d));
  if (y_trial > 0 && f_trial <= rounding<Real> * trial.mean_stress) {
    out.point.stress = add_mean(s_trial, trial.mean_stress);
    out.point.plastic_strain = in.eps_d;
    return out;
  }
  in.slopes_start = slopes(m, in.e_start, in.start, in.sin3theta);
  const auto end = solve(m, in, candidate(m, in, trial), out.converged);
  const Real p = end.pressure.mean_stress, x = end.multiplier;
  out.plastic = x > 0;
  out.nonconvex = out.plastic && !end.slopes.convex;
  out.point.plastic_strain = in.eps_d + x;
  // On the yield surface all along: p (q/p + dilatancy), at mean values.
  out.dissipation = std::max(
      (in.start.mean_stress + p) / 2 *
          (x * (in.slopes_start.peak + end.slopes.peak) / 2 * end.mean_share + end.plastic_volumetric),
      Real(0));
  if (end.pressure.measure == 0) {
    const Real beyond =
        end.plastic_volumetric - in.volumetric - strain_to_zero_pressure(m, old.void_ratio, in.start.measure);
    out.point.separation_strain = std::max(beyond, std::numeric_limits<Real>::min());
    out.collapsed = y_trial > 0;
    return out;
  }
  const Real q = out.plastic ? p * end.slopes.peak * end.share : end.q_trial; // (8)
  out.point.stress = add_mean(scale(q_trial > 0 ? q / q_trial : Real(0), s_trial), p);
  // Turn of the deviator, of which a radial return takes the direction at its end (19).
  if (x > 0 && in.q_start * q_trial > 0) {
    const Real cosine = Real(1.5) * contract(s_old, s_trial) / (in.q_start * q_trial);
    const Real sine = std::sqrt(std::max(1 - cosine * cosine, Real(0)));
    out.error += sine / 4 * std::min(3 * end.shear_modulus * x / end.q_trial, Real(1));
  }
  out.error += in.stiffening * x * m.given.A_d *
               (std::abs(end.slopes.transformation - in.slopes_start.transformation) +
                std::abs(end.slopes.peak - in.slopes_start.peak)) /
               (2 * (1 - m.given.n) * (end.pressure.measure + m.floor_measure));
  return out;
}

/// One substep: separation takes its share of the strain first.
template <class Real, int N>
Substep<Real, N> substep(const Material<Real>& m, const Point<Real, N>& old,
                         const SymmetricTensor<Real, N>& strain) {
  if (old.separation_strain <= 0) return stressed_substep(m, old, strain);
  const Real volumetric = trace(strain), left = volumetric - old.separation_strain;
  if (left <= 0) {
    Substep<Real, N> out;
    out.point = {{}, void_ratio_after(old.void_ratio, volumetric), old.plastic_strain, -left};
    return out;
  }
  const Point<Real, N> closed = {
      {}, void_ratio_after(old.void_ratio, old.separation_strain), old.plastic_strain, 0};
  return stressed_substep(m, closed, scale(left / volumetric, strain));
}

} // namespace

template <class Real>
Material<Real>::Material(const Parameters<Real>& parameters)
    : given(parameters), shear_ratio(Real(1.5) * (1 - 2 * given.nu) / (1 + given.nu)), // (2)
      tan_phi(std::tan(given.phi * Real(0.017453292519943295))), floor_pressure(given.p_min / given.p_at),
      floor_stiffness(std::pow(floor_pressure, given.n)), floor_measure(floor_pressure / floor_stiffness) {}

template <class Real, int N>
Point<Real, N> initial_point(const Material<Real>& m, const SymmetricTensor<Real, N>& stress, Real e) {
  constexpr Real largest_share = Real(0.99);
  Point<Real, N> point{stress, e, 0, 0};
  const Real p = trace(stress) / 3;
  if (!(p > 0)) return {{}, e, 0, 0};
  const auto s = deviator(stress);
  const Real q = deviatoric_stress(s);
  const auto M = slopes(m, e, pressure_of_mean_stress(m, p), sin_3theta(s, q));
  const Real share = std::min(q / (p * M.peak), largest_share);
  point.plastic_strain = m.given.k_p * share / (1 - share); // (8) = 0
  return point;
}

template <class Real, int N>
SymmetricTensor<Real, N> elastic_stress(const Material<Real>& m, const Point<Real, N>& point,
                                        const SymmetricTensor<Real, N>& strain_increment) {
  const Real K = bulk_modulus(m, point.void_ratio, pressure_of_mean_stress(m, trace(point.stress) / 3));
  return add_mean(add(point.stress, 2 * m.shear_ratio * K, deviator(strain_increment)),
                  K * trace(strain_increment));
}

template <class Real, int N>
Update<Real, N> update(const Material<Real>& m, const Point<Real, N>& old,
                       const SymmetricTensor<Real, N>& strain_increment) noexcept {
  Update<Real, N> out{old, Status::elastic, 0, false};
  Real sum = old.void_ratio + old.plastic_strain + old.separation_strain;
  for (int c = 0; c < N; ++c) sum += std::abs(old.stress[c]) + std::abs(strain_increment[c]);
  if (!std::isfinite(sum) || !(old.void_ratio > 0) || old.plastic_strain < 0) {
    out.status = Status::bad_input;
    return out;
  }
  bool plastic = false, cut = false;
  int done = 0, size = ticks_per_increment;
  while (done < ticks_per_increment) {
    size = std::min(size, ticks_per_increment - done);
    const auto part = scale(Real(size) / ticks_per_increment, strain_increment);
    const auto next = substep(m, out.point, part);
    const bool accepted = next.converged && next.error <= Real(substep_tolerance) &&
                          !(next.collapsed && size > ticks_of_collapse);
    if (accepted || (size == 1 && next.converged)) {
      out.point = next.point;
      out.dissipation += next.dissipation;
      plastic = plastic || next.plastic;
      out.nonconvex = next.nonconvex;
      done += size;
      size *= 2;
    } else if (size == 1) {
      out = {old, Status::exhausted, 0, false};
      return out;
    } else {
      cut = true;
      size = std::max(size / 4, 1);
    }
  }
  out.status = out.point.separation_strain > 0 ? Status::stress_free
               : cut                           ? Status::substepped
               : plastic                       ? Status::plastic
                                               : Status::elastic;
  return out;
}

#define SIMSAND_INSTANTIATE(Real, N)                                                                         \
  template Point<Real, N> initial_point(const Material<Real>&, const SymmetricTensor<Real, N>&, Real);       \
  template SymmetricTensor<Real, N> elastic_stress(const Material<Real>&, const Point<Real, N>&,             \
                                                   const SymmetricTensor<Real, N>&);                         \
  template Update<Real, N> update(const Material<Real>&, const Point<Real, N>&,                              \
                                  const SymmetricTensor<Real, N>&) noexcept;
template struct Material<float>;
template struct Material<double>;
SIMSAND_INSTANTIATE(float, 4)
SIMSAND_INSTANTIATE(float, 6)
SIMSAND_INSTANTIATE(double, 4)
SIMSAND_INSTANTIATE(double, 6)

} // namespace simsand
