// SPDX-License-Identifier: BSD-3-Clause
// The stress update: EQUATIONS.md, section "Update". One substep is a scalar problem in the measure y of the
// mean stress at its end; the yield condition gives the multiplier of each y in closed form.
#include "vumat/simsand.hpp"
#include "vumat/substep.hpp"

namespace simsand {
namespace {

/// Contraction alone may empty a point of its stress only in substeps as short as this.
constexpr int ticks_of_collapse = ticks_per_increment / 16;

/// A substep of one point, and what may refuse it.
template <class Real, int N> struct Attempt : Substep<Real, N> {
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

/// The end of a point that lost its stress.
template <class Real, int N>
Substep<Real, N> parted_end(const Material<Real>& m, const Increment<Real>& in, const Candidate<Real>& end) {
  const Real beyond =
      end.plastic_volumetric - in.volumetric - strain_to_zero_pressure(m, in.e_start, in.start.measure);
  const Real gap = std::max(beyond, tiny<Real>);
  return {
      {{}, in.e_end, in.eps_d + end.multiplier, gap}, plastic_work(in, end), 0, end.multiplier > 0, false};
}

/// One substep of a point that carries stress or is about to.
template <class Real, int N>
Attempt<Real, N> stressed_substep(const Material<Real>& m, const Point<Real, N>& old,
                                  const SymmetricTensor<Real, N>& strain) {
  auto trial = elastic_trial(m, old, strain);
  if (trial.inside) return {elastic_end(m, trial)};
  auto& in = trial.in;
  in.slopes_start = slopes(m, in.e_start, in.start, sin_3theta(trial.s_old, in.q_start));
  const auto flow = turn_deviator(m, trial);
  Attempt<Real, N> out;
  Slopes<Real> at_trial;
  set_tangents(m, trial.critical, trial.density, at_trial);
  const auto first = candidate(m, in, trial.pressure, at_angle(at_trial, in.sin3theta));
  const auto end = solve(m, in, first, out.converged);
  const bool parted = end.pressure.measure == 0;
  static_cast<Substep<Real, N>&>(out) =
      parted ? parted_end<Real, N>(m, in, end) : plastic_end(m, trial, flow, end);
  out.collapsed = parted && trial.measure > 0;
  return out;
}

/// One substep: separation takes its share of the strain first.
template <class Real, int N>
Attempt<Real, N> substep(const Material<Real>& m, const Point<Real, N>& old,
                         const SymmetricTensor<Real, N>& strain) {
  if (old.separation_strain <= 0) return stressed_substep(m, old, strain);
  const Real volumetric = trace(strain), left = volumetric - old.separation_strain;
  if (left <= 0) {
    const Real gap = std::max(-left, tiny<Real>); // closed exactly, but not loaded: stress free
    return {
        {{{}, void_ratio_after(old.void_ratio, volumetric), old.plastic_strain, gap}, 0, 0, false, false}};
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
