// SPDX-License-Identifier: BSD-3-Clause
// The points of a block in lanes, in rounds of one substep: neighbours side by side in the first, then those that
// have strain left, gathered from columns. What lanes refuse is updated one by one. Every lane is alone with its
// numbers, so a point's answer depends neither on its neighbours nor on the size of the block.
#pragma once
#include "vumat/block.hpp"
#include "vumat/progress.hpp"

namespace simsand {

/// Points of a pass between their substeps, component by component; positions are from 0.
template <class Real, int N> struct Points {
  using Column = Real[points_of_pass];
  alignas(64) Column stress[N], strain[N], void_ratio, plastic_strain, separation_strain;
  alignas(64) Column done, size, dissipation, status, nonconvex;
};

/// Calls f(lanes, column) for what a substep changes.
template <class Real, int N, class F>
void each_changed(Progress<Real, N>& at, Points<Real, N>& a, const F& f) {
  for (int c = 0; c < N; ++c) f(at.point.stress[c], a.stress[c]);
  f(at.point.void_ratio, a.void_ratio);
  f(at.point.plastic_strain, a.plastic_strain);
  f(at.done, a.done);
  f(at.size, a.size);
  f(at.dissipation, a.dissipation);
  f(at.status, a.status);
  f(at.nonconvex, a.nonconvex);
}

template <class Real, int N> bool unfinished(const Points<Real, N>& a, int k) {
  return (a.status[k] >= 0) & (a.done[k] < 1);
}

/// Room for a value that is not set to anything.
template <class T> union Unset {
  T value;
  Unset() {}
};

/// Positions, and what to do with some; room for the lanes that fill the last register.
template <class Real> struct List {
  int count = 0, position[points_of_pass + lane_count<Real>];

  void add(int at, bool really) {
    position[count] = at;
    count += really;
  }
  /// Repeats the last of `used` positions until lanes are full.
  void fill(int used) {
    for (int end = used; end % lane_count<Real> != 0; ++end) position[end] = position[used - 1];
  }
};

template <class Real, int N> void gather(Points<Real, N>& a, const int* position, Progress<Real, N>& at) {
  const auto take = [&](auto& lanes, const Real* column) {
    for (int i = 0; i < lane_count<Real>; ++i) lanes.set(i, column[position[i]]);
  };
  each_changed(at, a, take);
  for (int c = 0; c < N; ++c) take(at.strain[c], a.strain[c]);
  at.point.separation_strain = Real(0);
}

template <class Real, int N> void scatter(Progress<Real, N>& at, Points<Real, N>& a, const int* position) {
  each_changed(at, a, [&](const auto& lanes, Real* column) {
    for (int i = 0; i < lane_count<Real>; ++i) column[position[i]] = lanes[i];
  });
}

/// Neighbours of a block, from a point on: as many as there are lanes, or (`whole` false) the last of a block.
template <class Real, bool whole> struct Row {
  using Lane = Lanes<Real, lane_count<Real>>;
  int points, first, count;

  /// Component c of an array; the last stands for points beyond the block.
  Lane load(const Real* array, int c) const {
    const Real* from = array + std::size_t(c) * points + first;
    if constexpr (whole) return Lane::read(from);
    if (count == 1) return Lane(*from);
    Lane a;
    for (int i = 0; i < lane_count<Real>; ++i) a.set(i, from[std::min(i, count - 1)]);
    return a;
  }
  /// Writes lanes where the mask holds.
  void store(const Lane& a, const Mask<Lane>& mask, bool everywhere, Real* array, int c) const {
    Real* to = array + std::size_t(c) * points + first;
    if (whole && everywhere) return a.write(to);
    for (int i = 0; i < count; ++i)
      if (everywhere || mask[i]) to[i] = a[i];
  }
};

/// Calls f(row, i) for the rows of some points of a block.
template <class Real, class F> void each_row(const Block<Real>& b, int first, int count, const F& f) {
  constexpr int lanes = lane_count<Real>;
  int i = 0;
  for (; (i + 1) * lanes <= count; ++i) f(Row<Real, true>{b.points, first + i * lanes, lanes}, i);
  if (i * lanes < count) f(Row<Real, false>{b.points, first + i * lanes, count - i * lanes}, i);
}

/// Points before their increments.
template <class Real, int N, class Row>
void load_points(const Block<Real>& b, const Row& row, Progress<Real, N>& at) {
  for (int c = 0; c < N; ++c) {
    at.point.stress[c] = -row.load(b.stress_old, c);
    at.strain[c] = -row.load(b.strain, c);
  }
  at.point.void_ratio = row.load(b.state_old, statev::void_ratio);
  at.point.plastic_strain = row.load(b.state_old, statev::plastic_deviatoric_strain);
  at.point.separation_strain = row.load(b.state_old, statev::separation_strain);
  at.done = at.dissipation = at.status = at.nonconvex = Real(0);
  at.size = Real(1);
}

/// Writes neighbours to columns.
template <class Real, int N> void put_points(Work<Real, N>& w, Points<Real, N>& a, int first) {
  const auto put = [&](const auto& values, Real* column) { values.write(column + first); };
  each_changed(w, a, put);
  put(w.point.separation_strain, a.separation_strain);
  for (int c = 0; c < N; ++c) put(w.strain[c], a.strain[c]);
}

/// A substep of the points listed. Afterwards those with strain left are listed.
template <class Real, int N>
__attribute__((flatten)) void next_round(const Material<Real>& m, Points<Real, N>& a, List<Real>& list,
                                         Work<Real, N>* works) {
  const int count = std::exchange(list.count, 0);
  list.fill(count);
  Team<Real, N> team;
  for (int i = 0; i < count; i += lane_count<Real>) team.member[team.count++] = works + i / lane_count<Real>;
  for (int i = 0; i < team.count; ++i) gather(a, list.position + i * lane_count<Real>, works[i]);
  try_elastic(m, team);
  try_plastic(m, team);
  for (int i = 0; i < team.count; ++i) scatter(works[i], a, list.position + i * lane_count<Real>);
  for (int i = 0; i < count; ++i) list.add(list.position[i], unfinished(a, list.position[i]));
}

/// The whole increment of `count` points of a block from one on. Afterwards those with strain left are listed; if
/// few yield they are left for a round where they fill their registers.
template <class Real, int N>
__attribute__((flatten)) void first_round(const Material<Real>& m, const Block<Real>& b, int from, int count,
                                          Points<Real, N>& a, List<Real>& list, Work<Real, N>* works) {
  Team<Real, N> team;
  each_row(b, from, count, [&](const auto& row, int i) {
    load_points(b, row, works[i]);
    team.member[team.count++] = works + i;
  });
  const auto put = [&] {
    for (int i = 0; i < team.count; ++i) put_points(works[i], a, i * lane_count<Real>);
    list.count = 0;
    for (int k = 0; k < count; ++k) list.add(k, unfinished(a, k));
  };
  try_elastic(m, team);
  team.each([](auto& w) { stay_apart(w); });
  put();
  const int full = team.without(&Work<Real, N>::rests).count * lane_count<Real>;
  if (list.count > 0 && (team.count == 1 || list.count > full * 3 / 4)) {
    try_plastic(m, team);
    put();
  }
}

/// Writes points to the block, but for those that lanes refused.
template <class Real, int N, class Row>
void store_points(const Block<Real>& b, const Row& row, const Points<Real, N>& a, int first) {
  using Lane = typename Row::Lane;
  const auto column = [&](const Real* values) { return Lane::read(values + first); };
  const Lane zero = Real(0), status = column(a.status);
  const Mask<Lane> through = status >= zero;
  const bool all_through = all(through);
  const auto put = [&](Real* array, int c, const Lane& value) {
    row.store(value, through, all_through, array, c);
  };
  SymmetricTensor<Lane, N> twice_mean, strain;
  for (int c = 0; c < N; ++c) {
    const Lane stress = column(a.stress[c]);
    twice_mean[c] = stress - row.load(b.stress_old, c);
    strain[c] = column(a.strain[c]);
    put(b.stress_new, c, 0 - stress); // no -0
  }
  // A quotient, as a product could be fused with the sum for some blocks and not for others.
  const Lane density = row.load(b.density, 0), work = contract(twice_mean, strain) * Real(0.5);
  const auto per_mass = [&](const Lane& energy) { return select(density > zero, energy / density, zero); };
  put(b.state_new, statev::void_ratio, column(a.void_ratio));
  put(b.state_new, statev::plastic_deviatoric_strain, column(a.plastic_strain));
  put(b.state_new, statev::separation_strain, max(column(a.separation_strain), zero));
  put(b.state_new, statev::status, status);
  put(b.state_new, statev::nonconvex_updates,
      row.load(b.state_new, statev::nonconvex_updates) + column(a.nonconvex));
  put(b.internal_new, 0, row.load(b.internal_new, 0) + per_mass(work));
  put(b.inelastic_new, 0, row.load(b.inelastic_new, 0) + per_mass(column(a.dissipation)));
}

/// What a pass gave; what lanes refused is updated alone.
template <class Real, int N>
__attribute__((flatten)) void store_pass(const Block<Real>& b, int from, int count,
                                         const Points<Real, N>& a) {
  each_row(b, from, count, [&](const auto& row, int i) { store_points(b, row, a, i * lane_count<Real>); });
}

/// Up to points_of_pass points from one on.
template <class Real, int N>
void run_pass(const Material<Real>& m, const Block<Real>& b, int from, int count) {
  Points<Real, N> a;
  Unset<Work<Real, N>[vectors_of_pass<Real>]> room;
  auto* const works = room.value;
  List<Real> list;
  first_round<Real, N>(m, b, from, count, a, list, works);
  while (list.count > 0) next_round<Real, N>(m, a, list, works);
  store_pass<Real, N>(b, from, count, a);
  for (int k = 0; k < count; ++k)
    if (a.status[k] < 0) run_point<Real, N>(m, b, Task::increment, from + k);
}

template <class Real, int N> void run_lanes(const Material<Real>& m, const Block<Real>& b) {
  for (int from = 0; from < b.points; from += points_of_pass)
    run_pass<Real, N>(m, b, from, std::min(points_of_pass, b.points - from));
}

} // namespace simsand
