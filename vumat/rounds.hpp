// SPDX-License-Identifier: BSD-3-Clause
// The increments of a block, in rounds of one substep: neighbours share registers in the first, then the points that
// have strain left, gathered from columns. What the update leaves unsolved is rescued one by one. Every lane is alone
// with its numbers, so the answer of a point depends neither on its neighbours nor on the size of the block.
#pragma once
#include "vumat/block.hpp"

namespace simsand {

/// One number of every point of a pass, which are numbered from 0.
template <class T> struct Column { alignas(64) T at[points_of_pass]; };

/// Points of a pass between their substeps.
template <class T, int N> using PassColumns = IncrementProgress<Column<T>, N>;

template <class T, int N> bool is_unfinished(const PassColumns<T, N>& a, int k) {
  return (a.status.at[k] >= 0) & (a.applied.at[k] < 1);
}

/// Most rounds of a pass. Points that need more substeps are left to the rescue.
inline constexpr int largest_round_count = 1024;

/// Memory for a value that is not initialised.
template <class V> union Uninitialised {
  V value;
  Uninitialised() {}
};

/// The workspaces of a pass.
template <class T, int N> using Workspaces = SubstepWorkspace<Lane<T>, N>[points_of_pass / lane_count<T>];

/// Positions of points, and space for those that fill the last register.
template <class T> struct PointList {
  int count = 0, position[points_of_pass + lane_count<T>];

  void add_if(bool condition, int at) {
    position[count] = at;
    count += condition;
  }
  /// Repeats the last of `used` positions until the last register is full.
  void fill_register(int used) {
    for (int end = used; end % lane_count<T> != 0; ++end) position[end] = position[used - 1];
  }
};

/// Calls f(value, column) for what a substep changes.
template <class Real, int N, class T, class F>
void each_changed(IncrementProgress<Real, N>& at, PassColumns<T, N>& a, const F& f) {
  for (int c = 0; c < N; ++c) f(at.state.stress[c], a.state.stress[c].at);
  f(at.state.void_ratio, a.state.void_ratio.at);
  f(at.state.plastic_strain, a.state.plastic_strain.at);
  f(at.applied, a.applied.at);
  f(at.substep, a.substep.at);
  f(at.dissipation, a.dissipation.at);
  f(at.status, a.status.at);
  f(at.nonconvex, a.nonconvex.at);
}

/// Calls f(value, column) for what it does not change.
template <class Real, int N, class T, class F>
void each_kept(IncrementProgress<Real, N>& at, PassColumns<T, N>& a, const F& f) {
  for (int c = 0; c < N; ++c) f(at.strain[c], a.strain[c].at);
  f(at.state.separation_strain, a.state.separation_strain.at);
}

/// Points at any positions, one in each lane.
template <class Real, int N, class T>
void gather(PassColumns<T, N>& a, const int* position, IncrementProgress<Real, N>& at) {
  const auto take = [&](Real& value, const T* column) {
    for (int i = 0; i < lanes_of<Real>; ++i) set_lane(value, i, column[position[i]]);
  };
  each_changed(at, a, take);
  each_kept(at, a, take);
}

template <class Real, int N, class T>
void scatter(IncrementProgress<Real, N>& at, const int* position, PassColumns<T, N>& a) {
  each_changed(at, a, [&](const Real& value, T* column) {
    for (int i = 0; i < lanes_of<Real>; ++i) column[position[i]] = lane(value, i);
  });
}

/// A substep of the points listed. Afterwards those with strain left are listed.
template <class T, int N>
__attribute__((flatten)) void next_round(const Material<T>& m, PassColumns<T, N>& a, PointList<T>& list,
                                         Workspaces<T, N>& workspaces) {
  constexpr int lanes = lane_count<T>;
  const int count = std::exchange(list.count, 0);
  list.fill_register(count);
  RegisterGroup<Lane<T>, N> group;
  for (int i = 0; i < count; i += lanes) group.add(workspaces[i / lanes]);
  for (int i = 0; i < group.count; ++i) gather(a, list.position + i * lanes, workspaces[i]);
  try_elastic(m, group);
  try_plastic(m, group);
  for (int i = 0; i < group.count; ++i) scatter(workspaces[i], list.position + i * lanes, a);
  for (int i = 0; i < count; ++i) list.add_if(is_unfinished(a, list.position[i]), list.position[i]);
}

/// The whole increment of `count` points of a block from one on. Afterwards those with strain left are listed. If few
/// yield, they are left for a round in which they fill their registers.
template <class T, int N>
__attribute__((flatten)) void first_round(const Material<T>& m, const Block<T>& b, int from, int count,
                                          PassColumns<T, N>& a, PointList<T>& list,
                                          Workspaces<T, N>& workspaces) {
  constexpr int lanes = lane_count<T>;
  RegisterGroup<Lane<T>, N> group;
  each_slice(b, from, count, [&](const auto& slice, int i) {
    load_points<Lane<T>, N>(b, slice, workspaces[i]);
    group.add(workspaces[i]);
  });
  const auto write_columns = [&] {
    for (int i = 0; i < group.count; ++i) {
      const auto put = [&](const auto& value, T* column) { write(value, column + i * lanes); };
      each_changed(workspaces[i], a, put);
      each_kept(workspaces[i], a, put);
    }
    list.count = 0;
    for (int k = 0; k < count; ++k) list.add_if(is_unfinished(a, k), k);
  };
  try_first(m, group);
  write_columns();
  const int filled = group.remaining(&SubstepWorkspace<Lane<T>, N>::excluded).count * lanes;
  if (list.count > 0 && (group.count == 1 || list.count > filled * 3 / 4)) {
    try_plastic(m, group);
    write_columns();
  }
}

/// Writes what a pass gave to the block.
template <class T, int N>
__attribute__((flatten)) void store_pass(const Block<T>& b, int from, int count, PassColumns<T, N>& a) {
  each_slice(b, from, count, [&](const auto& slice, int i) {
    IncrementProgress<Lane<T>, N> at;
    const auto take = [&](Lane<T>& value, const T* column) {
      value = read<Lane<T>>(column + i * lane_count<T>);
    };
    each_changed(at, a, take);
    each_kept(at, a, take);
    store_points(b, slice, slice.template load_tensor<N>(b.stress_old), at);
  });
}

/// Up to points_of_pass points from one on.
template <class T, int N> void run_pass(const Material<T>& m, const Block<T>& b, int from, int count) {
  Uninitialised<PassColumns<T, N>> columns;
  Uninitialised<Workspaces<T, N>> workspaces;
  PointList<T> list;
  auto& a = columns.value;
  first_round<T, N>(m, b, from, count, a, list, workspaces.value);
  for (int i = 0; i < largest_round_count && list.count > 0; ++i)
    next_round<T, N>(m, a, list, workspaces.value);
  for (int i = 0; i < list.count; ++i) a.status.at[list.position[i]] = T(unsolved);
  store_pass<T, N>(b, from, count, a);
  for (int k = 0; k < count; ++k)
    if (a.status.at[k] < 0) run_point<T, N>(m, b, Task::increment, from + k);
}

template <class T, int N> void run_increments(const Material<T>& m, const Block<T>& b) {
  for (int from = 0; from < b.points; from += points_of_pass)
    run_pass<T, N>(m, b, from, std::min(points_of_pass, b.points - from));
}

} // namespace simsand
