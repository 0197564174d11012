// SPDX-License-Identifier: BSD-3-Clause
// The arrays of one block: strides, component order and the turn of sign; points to and from them, side by side or alone.
#pragma once
#include "vumat/rescue.hpp"
#include "vumat/simsand.hpp"

namespace simsand {

/// Arrays of one block, those that the model reads or writes. Component c of point k is at [c * points + k].
template <class T> struct Block {
  int points, state_count;
  const T *density, *strain, *stress_old, *state_old, *internal_old, *inelastic_old;
  T *stress_new, *state_new, *internal_new, *inelastic_new;
};

enum class Task { increment, data_check, annealing };

/// Copies what is not changed, so that every output is written whatever happens next.
template <class T> void keep_old(const Block<T>& b) {
  std::copy_n(b.state_old, std::size_t(b.state_count) * b.points, b.state_new);
  std::copy_n(b.internal_old, b.points, b.internal_new);
  std::copy_n(b.inelastic_old, b.points, b.inelastic_new);
}

template <class T> void fail(const Block<T>& b, int components, int k, int code) {
  for (int c = 0; c < components; ++c)
    b.stress_new[std::size_t(c) * b.points + k] = std::numeric_limits<T>::quiet_NaN();
  if (b.state_count > statev::status) b.state_new[std::size_t(statev::status) * b.points + k] = T(code);
}

/// Points of a block side by side, from one on: as many as a Real holds, or (`whole` false) the last of the block.
template <class Real, bool whole> struct BlockSlice {
  using T = Scalar<Real>;
  int points, first, count;

  /// Component c of an array; the last point fills lanes beyond the block.
  Real load(const T* array, int c) const {
    const T* from = array + std::size_t(c) * points + first;
    if constexpr (whole) return read<Real>(from);
    if (count == 1) return Real(*from);
    Real a;
    for (int i = 0; i < lanes_of<Real>; ++i) set_lane(a, i, from[std::min(i, count - 1)]);
    return a;
  }
  /// Writes lanes where the mask holds.
  void store(const Real& a, const Mask<Real>& mask, T* array, int c) const {
    T* to = array + std::size_t(c) * points + first;
    if constexpr (whole)
      write(select(mask, a, read<Real>(to)), to);
    else
      for (int i = 0; i < count; ++i)
        if (mask[i]) to[i] = a[i];
  }
  /// A symmetric tensor, compression positive on this side.
  template <int N> SymmetricTensor<Real, N> load_tensor(const T* array) const {
    SymmetricTensor<Real, N> t;
    for (int c = 0; c < N; ++c) t[c] = -load(array, c);
    return t;
  }
};

/// Calls f(slice, i) for the slices of some points of a block.
template <class T, class F> void each_slice(const Block<T>& b, int first, int count, const F& f) {
  constexpr int lanes = lane_count<T>;
  int i = 0;
  for (; (i + 1) * lanes <= count; ++i) f(BlockSlice<Lane<T>, true>{b.points, first + i * lanes, lanes}, i);
  if constexpr (lanes > 1)
    if (i * lanes < count) f(BlockSlice<Lane<T>, false>{b.points, first + i * lanes, count - i * lanes}, i);
}

/// Points before their increments.
template <class Real, int N, bool whole>
void load_points(const Block<Scalar<Real>>& b, const BlockSlice<Real, whole>& slice,
                 IncrementProgress<Real, N>& at) {
  const auto old = [&](int variable) { return slice.load(b.state_old, variable); };
  begin_increment<Real, N>(at,
                           {slice.template load_tensor<N>(b.stress_old), old(statev::void_ratio),
                            old(statev::plastic_deviatoric_strain), old(statev::separation_strain)},
                           slice.template load_tensor<N>(b.strain));
}

/// Writes points after their increments, with their energies per mass, but for those of negative status.
template <class Real, int N, bool whole>
void store_points(const Block<Scalar<Real>>& b, const BlockSlice<Real, whole>& slice,
                  const SymmetricTensor<Real, N>& old_stress, const IncrementProgress<Real, N>& at) {
  const Real zero = 0;
  const Mask<Real> valid = at.status >= zero;
  const auto put = [&](Scalar<Real>* array, int c, const Real& value) {
    slice.store(value, valid, array, c);
  };
  for (int c = 0; c < N; ++c) put(b.stress_new, c, 0 - at.state.stress[c]); // no -0
  put(b.state_new, statev::void_ratio, at.state.void_ratio);
  put(b.state_new, statev::plastic_deviatoric_strain, at.state.plastic_strain);
  put(b.state_new, statev::separation_strain, at_least(at.state.separation_strain, 0));
  put(b.state_new, statev::status, at.status);
  put(b.state_new, statev::nonconvex_updates,
      slice.load(b.state_new, statev::nonconvex_updates) + at.nonconvex);
  // A quotient: a product could be fused with the sum in some blocks and not in others.
  const Real density = slice.load(b.density, 0);
  const Real work = contract(add(old_stress, Real(1), at.state.stress), at.strain) / 2;
  const auto per_mass = [&](const Real& energy) { return select(density > zero, energy / density, zero); };
  put(b.internal_new, 0, slice.load(b.internal_new, 0) + per_mass(work));
  put(b.inelastic_new, 0, slice.load(b.inelastic_new, 0) + per_mass(at.dissipation));
}

/// One point alone: a data check, an annealing call, or the increment of a point that the update leaves unsolved. At a
/// first call its state is made from the stress as given.
template <class T, int N> void run_point(const Material<T>& m, const Block<T>& b, Task task, int k) {
  const BlockSlice<T, true> slice{b.points, k, 1};
  IncrementProgress<T, N> at;
  load_points(b, slice, at);
  if (task == Task::annealing) at.strain = {};
  const auto stress = at.state.stress;
  if (at.state.void_ratio == 0) at.state = initial_state(m, stress, m.given.e0);
  const SoilState<T, N> given = {stress, at.state.void_ratio, at.state.plastic_strain,
                                 at.state.separation_strain};
  if (!is_admissible(given, at.strain)) return fail(b, N, k, int(Status::bad_input));
  if (task == Task::annealing) at.state = initial_state(m, at.state.stress, at.state.void_ratio);
  const auto old_stress = at.state.stress;
  if (task == Task::data_check) at.state.stress = elastic_stress(m, at.state, std::exchange(at.strain, {}));
  if (task == Task::increment) rescue(m, at);
  if (at.status < 0) return fail(b, N, k, int(at.status));
  store_points(b, slice, old_stress, at);
  if (task == Task::annealing) b.state_new[std::size_t(statev::nonconvex_updates) * b.points + k] = 0;
}

} // namespace simsand
