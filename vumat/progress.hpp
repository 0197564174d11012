// SPDX-License-Identifier: BSD-3-Clause
// Lanes of points on their way through their increments, each in its own substeps. What needs more than elastic
// or plastic substeps at positive mean stress is refused and left to `update`.
#pragma once
#include "vumat/substep.hpp"

namespace simsand {

/// Shortest substep, as a share of the increment.
inline constexpr double shortest_substep = 1. / ticks_per_increment;

template <class Real, int N> struct Progress {
  using Lane = Lanes<Real, lane_count<Real>>;
  Point<Lane, N> point;
  SymmetricTensor<Lane, N> strain; ///< of the whole increment
  Lane done, size;                 ///< shares of the increment: behind, and to be tried next
  Lane dissipation;
  Mask<Lane> plastic, nonconvex, cut;
  Mask<Lane> refused;
};

/// Whether a point is one for lanes: finite, admissible, and under stress.
template <class Real, int N>
Mask<Real> carries_stress(const Point<Real, N>& point, const SymmetricTensor<Real, N>& strain) {
  Real sum = point.void_ratio + point.plastic_strain;
  for (int c = 0; c < N; ++c) sum += abs(point.stress[c]) + abs(strain[c]);
  const Real zero = 0;
  return (sum <= std::numeric_limits<Scalar<Real>>::max()) & (point.void_ratio > zero) &
         (point.plastic_strain >= zero) & (point.separation_strain <= zero) & (trace(point.stress) > zero);
}

/// All lanes at the start of their increments.
template <class Real, int N> void begin(Progress<Real, N>& at) {
  at.done = at.dissipation = Real(0);
  at.size = Real(1);
  at.plastic = at.nonconvex = at.cut = at.done > Real(0);
  at.refused = !carries_stress(at.point, at.strain);
}

/// The points of `a` where the mask holds, else those of `b`.
template <class Real, int N>
Point<Real, N> select(const Mask<Real>& mask, const Point<Real, N>& a, Point<Real, N> b) {
  for (int c = 0; c < N; ++c) b.stress[c] = select(mask, a.stress[c], b.stress[c]);
  b.void_ratio = select(mask, a.void_ratio, b.void_ratio);
  b.plastic_strain = select(mask, a.plastic_strain, b.plastic_strain);
  return b;
}

/// Tries one substep of every lane that has strain left.
template <class Real, int N>
__attribute__((flatten, noinline)) void advance(const Material<Real>& m, Progress<Real, N>& at) {
  using Lane = typename Progress<Real, N>::Lane;
  const Lane zero = Real(0);
  const Mask<Lane> over = (at.done >= Real(1)) | at.refused;
  auto trial = elastic_trial(m, at.point, scale(at.size, at.strain));
  auto end = elastic_end(m, trial);
  Mask<Lane> solved = trial.inside, parted = zero > zero;
  if (!all(trial.inside | over)) {
    const auto flow = turn_deviator(m, trial);
    const auto found = newton(m, trial.in, trial.inside | over, solved);
    const auto plastic = plastic_end(m, trial, flow, found);
    end.point = select(trial.inside, end.point, plastic.point);
    end.dissipation = select(trial.inside, end.dissipation, plastic.dissipation);
    end.error = select(trial.inside, end.error, plastic.error);
    end.plastic = plastic.plastic & !trial.inside;
    end.nonconvex = plastic.nonconvex & !trial.inside;
    parted = (!trial.inside) & (found.pressure.measure <= zero);
    solved |= trial.inside;
  }
  const Lane shortest = Real(shortest_substep);
  const Mask<Lane> accepted =
      (!over) & (!parted) & solved & ((end.error <= Lane(Real(substep_tolerance))) | (at.size <= shortest));
  at.refused |= (!over) & !accepted & (parted | (at.size <= shortest));
  at.cut |= (!over) & !accepted;
  at.point = select<Lane, N>(accepted, end.point, at.point);
  at.dissipation += select(accepted, end.dissipation, zero);
  at.plastic |= accepted & end.plastic;
  at.nonconvex = (accepted & end.nonconvex) | (at.nonconvex & !accepted);
  at.done += select(accepted, at.size, zero);
  at.size = min(select(accepted, 2 * at.size, max(Real(0.25) * at.size, shortest)), 1 - at.done);
}

} // namespace simsand
