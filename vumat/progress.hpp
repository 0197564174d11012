// SPDX-License-Identifier: BSD-3-Clause
// Lanes of points on their way through their increments, each in its own substeps. Every part of a substep runs over
// many lanes before the next part does: the chain of one part is short enough for the processor to work on
// several lanes at once. What needs more than elastic or plastic substeps at positive mean stress is refused
// and left to `update`.
#pragma once
#include "vumat/substep.hpp"

namespace simsand {

/// Points of one pass: no block that a host passes is longer than a few of them.
inline constexpr int points_of_pass = 128;
template <class Real> inline constexpr int vectors_of_pass = points_of_pass / lane_count<Real>;

/// Shortest substep, as a share of the increment.
inline constexpr double shortest_substep = 1. / ticks_per_increment;

/// Status of a point that lanes refuse.
inline constexpr int refused = -1;

/// All numbers are lanes of Real, the status (or `refused`) and truths among them.
template <class Real, int N> struct Progress {
  using Lane = Lanes<Real, lane_count<Real>>;
  Point<Lane, N> point;
  SymmetricTensor<Lane, N> strain; ///< of the whole increment
  Lane done, size;                 ///< shares of the increment: behind, and to be tried next
  Lane dissipation, status, nonconvex;
};

/// Lanes with what a substep of theirs computes.
template <class Real, int N> struct Work : Progress<Real, N> {
  using Lane = Lanes<Real, lane_count<Real>>;
  Trial<Lane, N> trial;
  Flow<Lane, N> flow;
  Lane critical, density;    ///< void ratio e_c, ln (e_c / e)
  Candidate<Lane> full, end; ///< with all functions evaluated; a step of Newton's rule from there
  Lane measure_step, measure;
  Mask<Lane> rests, solved; ///< refused, or at its end without yielding
};

/// The points of `a` where the mask holds, else those of `b`.
template <class Real, int N>
Point<Real, N> select(const Mask<Real>& mask, const Point<Real, N>& a, Point<Real, N> b) {
  for (int c = 0; c < N; ++c) b.stress[c] = select(mask, a.stress[c], b.stress[c]);
  b.void_ratio = select(mask, a.void_ratio, b.void_ratio);
  b.plastic_strain = select(mask, a.plastic_strain, b.plastic_strain);
  return b;
}

/// Whether lanes can do an update.
template <class Real, int N>
Mask<Real> ordinary(const Point<Real, N>& point, const SymmetricTensor<Real, N>& strain) {
  return admissible(point, strain) & (abs(trace(strain)) <= Real(largest_series_strain<Scalar<Real>>));
}

/// Moves lanes `solved` to the end of their substep if its error allows; others of `tried` are to take a shorter one.
template <class Real, int N, class Lane>
void settle(Progress<Real, N>& at, const Substep<Lane, N>& end, const Mask<Lane>& tried,
            const Mask<Lane>& solved) {
  const Lane zero = Real(0), one = Real(1), shortest = Real(shortest_substep);
  const Mask<Lane> last = at.size <= shortest;
  const Mask<Lane> accepted = tried & solved & ((end.error <= Lane(Real(substep_tolerance))) | last);
  const Mask<Lane> rejected = tried & !accepted;
  at.point = select<Lane, N>(accepted, end.point, at.point);
  at.dissipation += select(accepted, end.dissipation, zero);
  at.nonconvex = select(accepted, select(end.nonconvex, one, zero), at.nonconvex);
  at.done += select(accepted, at.size, zero);
  at.status = select(accepted & end.plastic, max(at.status, one), at.status);
  const Lane cut = select(last, Lane(Real(refused)), Lane(Real(int(Status::substepped))));
  at.status = select(rejected, cut, at.status);
  const Lane next = select(accepted, 2 * at.size, max(Real(0.25) * at.size, shortest));
  at.size = select(tried, min(next, 1 - at.done), at.size);
}

/// Lanes that go through the parts of a substep together.
template <class Real, int N> struct Team {
  int count = 0;
  Work<Real, N>* member[vectors_of_pass<Real>];

  template <class F> void each(const F& part) const {
    for (int i = 0; i < count; ++i) part(*member[i]);
  }
  /// Those of whose lanes some are not in a mask.
  Team without(Mask<typename Work<Real, N>::Lane> Work<Real, N>::*mask) const {
    Team out;
    each([&](auto& w) {
      out.member[out.count] = &w;
      out.count += !all(w.*mask);
    });
    return out;
  }
};

/// Tries an elastic substep of lanes; those that yield are for a plastic one.
template <class Real, int N>
__attribute__((flatten, noinline)) void try_elastic(const Material<Real>& m, const Team<Real, N>& all_lanes) {
  using W = Work<Real, N>;
  using Lane = typename W::Lane;
  all_lanes.each([&](W& w) {
    const Lane zero = Real(0);
    w.rests =
        !(ordinary(w.point, w.strain) & (w.point.separation_strain <= zero) & (trace(w.point.stress) > zero));
    w.status = select(w.rests, Lane(Real(refused)), w.status);
  });
  const auto team = all_lanes.without(&W::rests);
  team.each([&](W& w) { begin_trial(m, w.point, scale(w.size, w.strain), w.trial); });
  team.each([&](W& w) { trial_measure(m, w.trial); });
  team.each([&](W& w) { trial_log_ratio(m, w.trial); });
  team.each([&](W& w) { trial_pressure(m, w.trial); });
  team.each([&](W& w) { trial_density(m, w.trial); });
  team.each([&](W& w) { trial_tangent(m, w.trial); });
  team.each([&](W& w) { end_trial(m, w.trial); });
  team.each([&](W& w) {
    const Mask<Lane> elastic = w.trial.inside & !w.rests;
    settle(w, elastic_end(w.trial), elastic, elastic);
    w.rests |= elastic;
  });
}

/// Newton's rule from the start, of each lane until it is solved. Steps by series find the neighbourhood of the
/// answer; a full evaluation there is corrected by a last step, too short for an error. Lanes that this leaves
/// unsolved, or that head for y = 0, are for shorter steps.
template <class Real, int N> void newton(const Material<Real>& m, Team<Real, N> team) {
  using W = Work<Real, N>;
  using Lane = typename W::Lane;
  const auto step = [&](Candidate<Lane> W::*from) {
    team.each([&](W& w) { w.measure_step = newton_step(m, w.trial.in, w.*from); });
    team.each([&](W& w) { shift(m, w.*from, w.measure_step, w.end); });
    team.each([&](W& w) { evaluate(m, w.trial.in, w.end); });
  };
  team.each([&](W& w) { first_candidate(m, w.trial.in, w.trial.pressure, w.full); });
  team.each([&](W& w) { evaluate(m, w.trial.in, w.full); });
  step(&W::full);
  step(&W::end);
  team.each([&](W& w) { w.measure = max(w.end.pressure.measure, Lane(Real(0))); });
  for (int k = 0; k <= largest_newton_count && team.count > 0; ++k) {
    team.each([&](W& w) { w.full.pressure.log_ratio = log_ratio_of_measure(m, w.measure); });
    team.each([&](W& w) {
      w.full.pressure = pressure_of_measure(m, w.measure, w.full.pressure.log_ratio);
      w.critical = critical_void_ratio(m, w.full.pressure.log_ratio);
    });
    team.each([&](W& w) { w.density = density(w.critical, w.trial.in.e_end); });
    team.each([&](W& w) { set_tangents(m, w.critical, w.density, w.full.slopes); });
    team.each([&](W& w) { w.full.slopes = at_angle(w.full.slopes, w.trial.in.sin3theta); });
    team.each([&](W& w) { evaluate(m, w.trial.in, w.full); });
    step(&W::full);
    team.each([&](W& w) {
      const Lane most = largest_multiplier(m, w.trial.in);
      w.solved |= solved(m, w.trial.in, w.end, most) & short_step(m, w.full, w.end);
      w.measure = select(w.solved, w.measure, max(w.end.pressure.measure, Lane(Real(0))));
    });
    team = team.without(&W::solved);
  }
}

/// Tries a plastic substep of the lanes that yield in their trials.
template <class Real, int N>
__attribute__((flatten, noinline)) void try_plastic(const Material<Real>& m, const Team<Real, N>& all_lanes) {
  using W = Work<Real, N>;
  using Lane = typename W::Lane;
  const auto team = all_lanes.without(&W::rests);
  team.each([&](W& w) { w.critical = critical_void_ratio(m, w.trial.in.start.log_ratio); });
  team.each([&](W& w) { w.density = density(w.critical, w.trial.in.e_start); });
  team.each([&](W& w) { set_tangents(m, w.critical, w.density, w.trial.in.slopes_start); });
  team.each([&](W& w) {
    auto& M = w.trial.in.slopes_start;
    M = at_angle(M, start_sin_3theta(w.trial));
  });
  team.each([&](W& w) { w.flow = turn_deviator(m, w.trial); });
  team.each([&](W& w) { w.solved = w.rests; });
  newton(m, team);
  team.each([&](W& w) {
    const Mask<Lane> parted = (w.end.pressure.measure <= Lane(Real(0))) & !w.rests;
    settle(w, plastic_end(m, w.trial, w.flow, w.end), !(w.rests | parted), w.solved);
    w.status = select(parted, Lane(Real(refused)), w.status);
  });
}

/// Lanes that carry no stress, and stay apart over the whole increment.
template <class Real, int N> void stay_apart(Progress<Real, N>& at) {
  using Lane = typename Progress<Real, N>::Lane;
  const Lane zero = Real(0), volumetric = trace(at.strain);
  const Mask<Lane> apart = ordinary(at.point, at.strain) & (at.point.separation_strain > zero) &
                           (volumetric <= at.point.separation_strain);
  const Lane gap = max(at.point.separation_strain - volumetric, Lane(tiny<Real>));
  for (int c = 0; c < N; ++c) at.point.stress[c] = select(apart, zero, at.point.stress[c]);
  at.point.void_ratio = select(apart, void_ratio_after(at.point.void_ratio, volumetric), at.point.void_ratio);
  at.point.separation_strain = select(apart, gap, at.point.separation_strain);
  at.done = select(apart, Lane(Real(1)), at.done);
  at.status = select(apart, Lane(Real(int(Status::stress_free))), at.status);
}

} // namespace simsand
