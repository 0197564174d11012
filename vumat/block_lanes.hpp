// SPDX-License-Identifier: BSD-3-Clause
// The points of a block in lanes: first each in one step, neighbours side by side; then those that need substeps,
// a lane taking the next one as soon as it is free; then what lanes refuse, one by one. Every lane is alone with its
// numbers, so a point's answer depends neither on its neighbours nor on the size of the block.
#pragma once
#include "vumat/block.hpp"
#include "vumat/progress.hpp"

namespace simsand {

/// Points of one pass: no block that a host passes is longer than a few of them.
inline constexpr int points_of_pass = 128;

/// Lanes of `count` values from an array; the last stands for those beyond it.
template <class Real> Lanes<Real, lane_count<Real>> load_lanes(const Real* from, int count) {
  Lanes<Real, lane_count<Real>> a;
  if (count >= lane_count<Real>)
    std::memcpy(&a, from, sizeof a);
  else
    for (int i = 0; i < lane_count<Real>; ++i) a.set(i, from[std::min(i, count - 1)]);
  return a;
}

/// Writes the first `count` lanes where the mask holds.
template <class Real, class Mask>
void store_lanes(const Lanes<Real, lane_count<Real>>& a, const Mask& mask, bool everywhere, Real* to,
                 int count) {
  if (everywhere && count >= lane_count<Real>)
    std::memcpy(to, &a, sizeof a);
  else
    for (int i = 0; i < count; ++i)
      if (mask[i]) to[i] = a[i];
}

/// One step of as many points as there are lanes, from k on. Returns which are through.
template <class Real, int N>
Progress<Real, N> first_step(const Material<Real>& m, const Block<Real>& b, int k) {
  using Lane = typename Progress<Real, N>::Lane;
  const int count = std::min(lane_count<Real>, b.points - k);
  const auto load = [&](const Real* array, int c) {
    return load_lanes(array + std::size_t(c) * b.points + k, count);
  };
  Progress<Real, N> at;
  SymmetricTensor<Lane, N> stress;
  for (int c = 0; c < N; ++c) {
    stress[c] = -load(b.stress_old, c);
    at.strain[c] = -load(b.strain, c);
  }
  at.point = {stress, load(b.state_old, statev::void_ratio),
              load(b.state_old, statev::plastic_deviatoric_strain),
              load(b.state_old, statev::separation_strain)};
  begin(at);
  advance(m, at);

  const Mask<Lane> through = (!at.refused) & (at.done >= Real(1));
  const bool all_through = all(through);
  const auto put = [&](Real* array, int c, Lane value) {
    store_lanes(value, through, all_through, array + std::size_t(c) * b.points + k, count);
  };
  const auto one_if = [](const Mask<Lane>& mask) { return select(mask, Lane(Real(1)), Lane(Real(0))); };
  for (int c = 0; c < N; ++c) put(b.stress_new, c, 0 - at.point.stress[c]); // no -0
  put(b.state_new, statev::void_ratio, at.point.void_ratio);
  put(b.state_new, statev::plastic_deviatoric_strain, at.point.plastic_strain);
  put(b.state_new, statev::separation_strain, Real(0));
  put(b.state_new, statev::status, one_if(at.plastic));
  put(b.state_new, statev::nonconvex_updates,
      load(b.state_new, statev::nonconvex_updates) + one_if(at.nonconvex));
  const Lane density = load(b.density, 0);
  const Lane volume = select(density > Real(0), 1 / density, Lane(Real(0)));
  const Lane work = contract(add(stress, Lane(Real(1)), at.point.stress), at.strain) * Real(0.5);
  put(b.internal_new, 0, load(b.internal_new, 0) + work * volume);
  put(b.inelastic_new, 0, load(b.inelastic_new, 0) + at.dissipation * volume);
  return at;
}

/// Puts point k in lane i, with a first substep of a quarter.
template <class Real, int N>
void enter(Progress<Real, N>& at, int i, const Point<Real, N>& point,
           const SymmetricTensor<Real, N>& strain) {
  for (int c = 0; c < N; ++c) {
    at.point.stress[c].set(i, point.stress[c]);
    at.strain[c].set(i, strain[c]);
  }
  at.point.void_ratio.set(i, point.void_ratio);
  at.point.plastic_strain.set(i, point.plastic_strain);
  at.point.separation_strain.set(i, Real(0));
  at.done.set(i, Real(0));
  at.size.set(i, Real(0.25));
  at.dissipation.set(i, Real(0));
  for (auto* mask : {&at.plastic, &at.nonconvex, &at.refused}) mask->set(i, false);
}

/// The point that leaves lane i.
template <class Real, int N> Update<Real, N> leave(const Progress<Real, N>& at, int i) {
  Update<Real, N> out{{}, Status::substepped, at.dissipation[i], at.nonconvex[i]};
  for (int c = 0; c < N; ++c) out.point.stress[c] = at.point.stress[c][i];
  out.point.void_ratio = at.point.void_ratio[i];
  out.point.plastic_strain = at.point.plastic_strain[i];
  return out;
}

/// The points listed, each in substeps.
template <class Real, int N>
void run_substepped(const Material<Real>& m, const Block<Real>& b, const int* list, int count) {
  if (count == 0) return;
  Progress<Real, N> at;
  int occupant[lane_count<Real>], entered = 0, left = 0;
  const auto fill = [&](int i, int k) {
    enter(at, i, load_point<Real, N>(m, b, k), load<Real, N>(b.strain, b.points, k));
  };
  for (int i = 0; i < lane_count<Real>; ++i) {
    occupant[i] = entered < count ? list[entered] : -1;
    fill(i, list[std::min(entered, count - 1)]);
    entered += occupant[i] >= 0;
  }
  while (left < count) {
    advance(m, at);
    for (int i = 0; i < lane_count<Real>; ++i) {
      const int k = occupant[i];
      if (k < 0 || !(at.refused[i] || at.done[i] >= 1)) continue;
      if (at.refused[i])
        run_point<Real, N>(m, b, Task::increment, k);
      else
        store_update(leave(at, i), load<Real, N>(b.stress_old, b.points, k),
                     load<Real, N>(b.strain, b.points, k), b, k);
      ++left;
      occupant[i] = entered < count ? list[entered++] : -1;
      if (occupant[i] >= 0) fill(i, occupant[i]);
    }
  }
}

template <class Real, int N> void run_lanes(const Material<Real>& m, const Block<Real>& b) {
  for (int from = 0; from < b.points; from += points_of_pass) {
    const int to = std::min(from + points_of_pass, b.points);
    int list[points_of_pass], count = 0;
    for (int k = from; k < to; k += lane_count<Real>) {
      const auto at = first_step<Real, N>(m, b, k);
      for (int i = 0; i < std::min(lane_count<Real>, to - k); ++i)
        if (at.refused[i])
          run_point<Real, N>(m, b, Task::increment, k + i);
        else if (at.done[i] < 1)
          list[count++] = k + i;
    }
    run_substepped<Real, N>(m, b, list, count);
  }
}

} // namespace simsand
