// SPDX-License-Identifier: BSD-3-Clause
// The stress update: EQUATIONS.md, section "Update". One substep is a scalar problem in the measure y of the
// mean stress at its end; the yield condition gives the multiplier of each y in closed form.
#include "vumat/simsand.hpp"
#include "vumat/zero_pressure.hpp"

namespace simsand {
namespace {

/// The longest substep in which a point may lose all its stress, or leave zero pressure against contraction at first.
constexpr int ticks_at_zero = ticks_per_increment / 4096;

/// A substep of one point, and what may refuse it.
template <class Real, int N> struct Attempt : Substep<Real, N> {
  bool converged = true;
  bool brief = false;   ///< p reached 0, or left it by dilation that followed on contraction
  bool regains = false; ///< p reached 0, from where dilation leads back to pressure
};

/// One substep of a point that carries stress or is about to.
template <class Real, int N>
Attempt<Real, N> stressed_substep(const Material<Real>& m, const Point<Real, N>& old,
                                  const SymmetricTensor<Real, N>& strain) {
  auto trial = elastic_trial(m, old, strain);
  if (trial.inside) return {elastic_end(trial)};
  auto& in = trial.in;
  in.slopes_start = slopes(m, in.e_start, in.start, start_sin_3theta(trial));
  const auto flow = turn_deviator(m, trial);
  Attempt<Real, N> out;
  Slopes<Real> at_trial;
  set_tangents(m, trial.critical, trial.density, at_trial);
  const auto first = candidate(m, in, trial.pressure, at_angle(at_trial, in.sin3theta));
  const auto end = solve(m, in, first, out.converged);
  const bool contracts = contracts_at_zero(m, in, end);
  if (end.pressure.measure > 0) {
    static_cast<Substep<Real, N>&>(out) = plastic_end(m, trial, flow, end);
    out.brief = contracts;
  } else if (contracts && in.volumetric > 0) {
    static_cast<Substep<Real, N>&>(out) = flow_in_contact<Real, N>(m, in, end);
  } else {
    static_cast<Substep<Real, N>&>(out) = parted_end<Real, N>(m, in, end);
    out.brief = true;
    out.regains = dilates_at_zero(m, in, end);
  }
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
  if (!admissible(old, strain_increment)) {
    out.status = Status::bad_input;
    return out;
  }
  const Real volumetric = trace(strain_increment);
  bool plastic = false, cut = false;
  int done = 0, size = ticks_per_increment;
  while (done < ticks_per_increment) {
    size = std::min(size, ticks_per_increment - done);
    const auto part = scale(Real(size) / ticks_per_increment, strain_increment);
    const auto next = substep(m, out.point, part);
    const bool accepted =
        next.converged && next.error <= Real(substep_tolerance) && !(next.brief && size > ticks_at_zero);
    if (accepted || (size == 1 && next.converged)) {
      out.point = next.point;
      out.dissipation += next.dissipation;
      plastic = plastic || next.plastic;
      out.nonconvex = next.nonconvex;
      done += size;
      out.point.void_ratio = // not summed up over many substeps
          void_ratio_after(old.void_ratio, volumetric * done / ticks_per_increment);
      if (next.regains && done < ticks_per_increment) out.point.separation_strain = 0;
      size *= 2;
    } else if (size == 1) {
      out = {old, Status::exhausted, 0, false};
      return out;
    } else {
      cut = true;
      size = std::max(size / 4, 1);
    }
  }
  if (!admissible(out.point, strain_increment)) { // a void ratio beyond all numbers
    out = {old, Status::exhausted, 0, false};
    return out;
  }
  if (trace(out.point.stress) == 0)
    out.point.separation_strain = std::max(out.point.separation_strain, tiny<Real>);
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
