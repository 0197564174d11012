// SPDX-License-Identifier: BSD-3-Clause
// Substeps have the trial, flow direction, end and acceptance of the update. What is added: a bracket around the
// solution, which bisection closes, and the ends at zero pressure.
#include "vumat/rescue.hpp"
#include "vumat/zero_pressure.hpp"

namespace simsand {
namespace {

/// Most evaluations of (16) in one substep.
constexpr int largest_evaluation_count = 100;

/// The longest substep, as a share of the increment, in which a point may lose all its stress, or leave zero pressure
/// against contraction at first.
constexpr double longest_at_zero = 1. / 4096;

/// The end of a substep, and what may refuse it.
template <class T, int N> struct RescuedEnd : SubstepEnd<T, N> {
  bool converged = true;
  bool at_zero = false; ///< p reached 0, or left it by dilation that followed on contraction
  bool regains = false; ///< p reached 0, from where dilation leads back to pressure
  int evaluations = 0;
};

template <class T>
EndCandidate<T> candidate(const Material<T>& m, const SubstepInvariants<T>& in, const Pressure<T>& end,
                          const Slopes<T>& at_end) {
  EndCandidate<T> c;
  c.pressure = end;
  c.slopes = at_end;
  evaluate(m, in, c);
  return c;
}

/// Solves (16) from a first candidate by Newton's rule, then secants, kept inside a bracket by bisection. An end at y = 0
/// with a positive residual is a point that has separated.
template <class T>
EndCandidate<T> solve_in_bracket(const Material<T>& m, const SubstepInvariants<T>& in, EndCandidate<T> c,
                                 bool& converged, int& evaluations) {
  // No dilatancy exceeds 3 A_d, so no y lies above `high`.
  const T largest_x = largest_multiplier(m, in);
  T low = 0,
    high = in.start.measure + in.bulk_factor * (std::max(in.volumetric, T(0)) + 3 * m.given.A_d * largest_x);
  bool low_known = false, stalled = false;
  T slope = residual_slope(m, in, c);
  for (int i = 0; i < largest_evaluation_count; ++i) {
    const T y = c.pressure.measure;
    if (is_solution(m, in, c, largest_x) || (y == 0 && c.residual > 0)) return c;
    if (c.residual > 0) {
      high = y;
    } else {
      low = y;
      low_known = true;
    }
    T next = y - c.residual / slope;
    if (!low_known && next <= 0) {
      next = 0;
    } else if (!(next > low && next < high) || stalled) {
      next = (low + high) / 2;
    }
    ++evaluations;
    const auto pressure = pressure_of_measure(m, next);
    const auto d = candidate(m, in, pressure, slopes(m, in.e_end, pressure, in.sin3theta));
    const T secant = (d.residual - c.residual) / (next - y);
    stalled = !stalled && std::abs(d.residual) > std::abs(c.residual) / 2;
    slope = secant > 0 ? secant : residual_slope(m, in, d);
    c = d;
  }
  converged = is_solution(m, in, c, largest_x);
  return c;
}

/// One substep of a point that carries stress or is about to.
template <class T, int N>
RescuedEnd<T, N> stressed_end(const Material<T>& m, const SoilState<T, N>& old,
                              const SymmetricTensor<T, N>& strain) {
  SubstepWorkspace<T, N> w;
  const OnePoint<T, N> one{w};
  begin_increment(w, old, strain);
  find_trials(m, one);
  if (w.trial.is_elastic) return {elastic_end(w)};
  find_flow(m, one);
  RescuedEnd<T, N> out;
  Slopes<T> at_trial;
  set_tangents(m, w.trial.critical, w.trial.log_state_ratio, at_trial);
  const auto first = candidate(m, w.in, w.trial.pressure, at_lode_angle(at_trial, w.in.sin3theta));
  const auto& end = w.end = solve_in_bracket(m, w.in, first, out.converged, out.evaluations);
  const bool contracts = contracts_at_zero(m, w.in, end);
  SubstepEnd<T, N>& result = out;
  if (end.pressure.measure > 0) {
    result = plastic_end(m, w);
    out.at_zero = contracts;
  } else if (contracts && w.in.volumetric > 0) {
    result = contact_end<T, N>(m, w.in, end);
  } else {
    result = separated_end<T, N>(m, w.in, end);
    out.at_zero = true;
    out.regains = dilates_at_zero(m, w.in, end);
  }
  return out;
}

/// One substep: a gap takes its share of the strain first; what is left once it has closed loads the grains.
template <class T, int N>
RescuedEnd<T, N> rescued_end(const Material<T>& m, const SoilState<T, N>& old,
                             const SymmetricTensor<T, N>& strain) {
  const T gap = old.separation_strain, volumetric = trace(strain), left = volumetric - gap;
  if (gap <= 0) return stressed_end(m, old, strain);
  if (left <= 0) return {{separated_state(old, volumetric), 0, 0, false, false}};
  const SoilState<T, N> closed = {{}, void_ratio_after(old.void_ratio, gap), old.plastic_strain, 0};
  return stressed_end(m, closed, scale(left / volumetric, strain));
}

} // namespace

template <class T, int N> int rescue(const Material<T>& m, IncrementProgress<T, N>& at) noexcept {
  const T e_start = at.state.void_ratio, volumetric = trace(at.strain);
  int work = 0;
  while (at.status >= 0 && at.applied < 1) {
    if (work >= largest_work) at.status = unsolved;
    if (at.status < 0) return work;
    const auto end = rescued_end(m, at.state, scale(at.substep, at.strain));
    work += 1 + end.evaluations;
    const bool too_long = end.at_zero && at.substep > T(longest_at_zero);
    const T before = at.applied;
    accept_or_cut<T, N>(at, end, true, end.converged && !too_long);
    // Whole numbers of the shortest substep, so that their sum is exact.
    at.substep = std::floor(at.substep / T(shortest_substep)) * T(shortest_substep);
    if (at.applied == before) continue;
    at.state.separation_strain = end.regains && at.applied < 1 ? T(0) : end.state.separation_strain;
    at.state.void_ratio =
        void_ratio_after(e_start, volumetric * at.applied); // not summed up over many substeps
  }
  if (!is_admissible(at.state, at.strain)) at.status = unsolved; // a void ratio beyond all numbers
  if (at.status < 0) return work;
  if (trace(at.state.stress) == 0) at.state.separation_strain = positive(at.state.separation_strain);
  if (at.state.separation_strain > 0) at.status = int(Status::stress_free);
  return work;
}

template int rescue(const Material<float>&, IncrementProgress<float, 4>&) noexcept;
template int rescue(const Material<float>&, IncrementProgress<float, 6>&) noexcept;
template int rescue(const Material<double>&, IncrementProgress<double, 4>&) noexcept;
template int rescue(const Material<double>&, IncrementProgress<double, 6>&) noexcept;

} // namespace simsand
