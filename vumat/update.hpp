// SPDX-License-Identifier: BSD-3-Clause
// One substep of points at positive mean stress: trial, solution, end, and acceptance by the estimated error. The same
// functions update one point and registers of points. What they cannot do is left to the rescue (rescue.hpp).
#pragma once
#include "vumat/end.hpp"

namespace simsand {

/// Accepted error of a substep (20).
inline constexpr double substep_tolerance = 0.05;
/// Shortest substep, as a share of the increment. It is accepted up to an error of `largest_error`.
inline constexpr double shortest_substep = 1. / 65536;
/// In place of a status: the point is left to the rescue, or, in the rescue, failed.
inline constexpr int unsolved = int(Status::exhausted);

/// The start of an increment.
template <class Real, int N>
void begin_increment(IncrementProgress<Real, N>& at, const SoilState<Real, N>& state,
                     const SymmetricTensor<Real, N>& strain) {
  at.state = state;
  at.strain = strain;
  at.applied = at.dissipation = at.status = at.nonconvex = Real(0);
  at.substep = Real(1);
}

/// The state of `a` where the mask holds, else that of `b`; but for separation.
template <class Real, int N>
SoilState<Real, N> select(const Mask<Real>& mask, const SoilState<Real, N>& a, SoilState<Real, N> b) {
  for (int c = 0; c < N; ++c) b.stress[c] = select(mask, a.stress[c], b.stress[c]);
  b.void_ratio = select(mask, a.void_ratio, b.void_ratio);
  b.plastic_strain = select(mask, a.plastic_strain, b.plastic_strain);
  return b;
}

/// Moves points that are `solved` to the end of their substep if its error allows, and doubles the next. Others of
/// those `tried` take a quarter of it next; at the shortest they are left unsolved.
template <class Real, int N>
void accept_or_cut(IncrementProgress<Real, N>& at, const SubstepEnd<Real, N>& end, const Mask<Real>& tried,
                   const Mask<Real>& solved) {
  const Real zero = 0, one = 1, shortest = Real(shortest_substep);
  const Mask<Real> last = at.substep <= shortest;
  const Real allowed = select(last, Real(largest_error), Real(substep_tolerance));
  const Mask<Real> accepted = tried & solved & (end.error <= allowed);
  const Mask<Real> rejected = tried & !accepted;
  at.state = select<Real, N>(accepted, end.state, at.state);
  at.dissipation += select(accepted, end.dissipation, zero);
  at.nonconvex = select(accepted, select(end.nonconvex, one, zero), at.nonconvex);
  at.applied += select(accepted, at.substep, zero);
  at.status = select(accepted & end.plastic, max(at.status, one), at.status);
  const Real cut = select(last, Real(unsolved), Real(int(Status::substepped)));
  at.status = select(rejected, cut, at.status);
  const Real next = select(accepted, 2 * at.substep, max(Real(0.25) * at.substep, shortest));
  at.substep = select(tried, min(next, 1 - at.applied), at.substep);
}

/// Whether the update can do an increment without the rescue, as far as its start tells.
template <class Real, int N>
Mask<Real> is_ordinary(const SoilState<Real, N>& state, const SymmetricTensor<Real, N>& strain) {
  return is_admissible(state, strain) & (abs(trace(strain)) <= Real(largest_series_strain));
}

/// Tries an elastic substep. Points that yield are for a plastic one; the others are excluded from it.
template <class Real, int N>
__attribute__((flatten, noinline)) void try_elastic(const MaterialOf<Real>& m,
                                                    const RegisterGroup<Real, N>& all_registers) {
  all_registers.each([&](auto& w) {
    const Real zero = 0;
    w.excluded = !(is_ordinary(w.state, w.strain) & (w.state.separation_strain <= zero) &
                   (trace(w.state.stress) > zero));
    w.status = select(w.excluded, Real(unsolved), w.status);
  });
  const auto group = all_registers.remaining(&SubstepWorkspace<Real, N>::excluded);
  find_trials(m, group);
  group.each([&](auto& w) {
    const Mask<Real> elastic = w.trial.is_elastic & !w.excluded;
    accept_or_cut<Real, N>(w, elastic_end(w), elastic, elastic);
    w.excluded |= elastic;
  });
}

/// Tries a plastic substep of the points that yield in their trials.
template <class Real, int N>
__attribute__((flatten, noinline)) void try_plastic(const MaterialOf<Real>& m,
                                                    const RegisterGroup<Real, N>& all_registers) {
  const auto group = all_registers.remaining(&SubstepWorkspace<Real, N>::excluded);
  find_flow(m, group);
  group.each([&](auto& w) { w.solved = w.excluded; });
  solve(m, group);
  group.each([&](auto& w) {
    const Mask<Real> separated = (w.end.pressure.measure <= 0) & !w.excluded;
    accept_or_cut<Real, N>(w, plastic_end(m, w), !(w.excluded | separated), w.solved);
    w.status = select(separated, Real(unsolved), w.status);
  });
}

/// The state of separated grains after a strain that leaves the gap open: no stress.
template <class Real, int N>
SoilState<Real, N> separated_state(const SoilState<Real, N>& old, Real volumetric) {
  const Real gap =
      positive(old.separation_strain - volumetric); // a gap that closes exactly bears no load yet
  return {{}, void_ratio_after(old.void_ratio, volumetric), old.plastic_strain, gap};
}

/// Ends the increments of separated grains whose gap stays open.
template <class Real, int N> void keep_separated(IncrementProgress<Real, N>& at) {
  const Real volumetric = trace(at.strain);
  const Mask<Real> apart = is_ordinary(at.state, at.strain) & (at.state.separation_strain > 0) &
                           (volumetric <= at.state.separation_strain);
  const auto end = separated_state(at.state, volumetric);
  at.state = select<Real, N>(apart, end, at.state);
  at.state.separation_strain = select(apart, end.separation_strain, at.state.separation_strain);
  at.applied = select(apart, Real(1), at.applied);
  at.status = select(apart, Real(int(Status::stress_free)), at.status);
}

/// The first substep of increments, as far as it is elastic or leaves grains separated.
template <class Real, int N> void try_first(const MaterialOf<Real>& m, const RegisterGroup<Real, N>& group) {
  try_elastic(m, group);
  group.each([](auto& w) { keep_separated<Real, N>(w); });
}

} // namespace simsand
