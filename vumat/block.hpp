// SPDX-License-Identifier: BSD-3-Clause
// The arrays of one block: strides, component order and the turn of sign; and the update of its points one by one.
#pragma once
#include "vumat/simsand.hpp"

namespace simsand {

/// Arrays of one block, those that the model reads or writes.
template <class Real> struct Block {
  int points, state_count;
  const Real *density, *strain, *stress_old, *state_old, *internal_old, *inelastic_old;
  Real *stress_new, *state_new, *internal_new, *inelastic_new;
};

enum class Task { increment, data_check, annealing };

/// Component c of point k, compression positive on this side.
template <class Real, int N> SymmetricTensor<Real, N> load(const Real* array, int points, int k) {
  SymmetricTensor<Real, N> t;
  for (int c = 0; c < N; ++c) t[c] = -array[std::size_t(c) * points + k];
  return t;
}

template <class Real, int N> void store(const SymmetricTensor<Real, N>& t, Real* array, int points, int k) {
  for (int c = 0; c < N; ++c) array[std::size_t(c) * points + k] = 0 - t[c]; // no -0
}

template <class Real> Real* state(Real* array, const Block<std::remove_const_t<Real>>& b, int index, int k) {
  return array + std::size_t(index) * b.points + k;
}

/// Copies what is not changed, so that every output is written whatever happens next.
template <class Real> void keep_old(const Block<Real>& b) {
  std::copy_n(b.state_old, std::size_t(b.state_count) * b.points, b.state_new);
  std::copy_n(b.internal_old, b.points, b.internal_new);
  std::copy_n(b.inelastic_old, b.points, b.inelastic_new);
}

template <class Real> void fail(const Block<Real>& b, int components, int k, Real code) {
  for (int c = 0; c < components; ++c)
    b.stress_new[std::size_t(c) * b.points + k] = std::numeric_limits<Real>::quiet_NaN();
  if (b.state_count > statev::status) *state(b.state_new, b, statev::status, k) = code;
}

template <class Real, int N> Point<Real, N> load_point(const Material<Real>& m, const Block<Real>& b, int k) {
  const auto stress = load<Real, N>(b.stress_old, b.points, k);
  const Real e = *state(b.state_old, b, statev::void_ratio, k);
  if (e == 0) return initial_point(m, stress, m.given.e0);
  return {stress, e, *state(b.state_old, b, statev::plastic_deviatoric_strain, k),
          *state(b.state_old, b, statev::separation_strain, k)};
}

template <class Real, int N>
void store_point(const Point<Real, N>& point, Status status, const Block<Real>& b, int k) {
  store(point.stress, b.stress_new, b.points, k);
  *state(b.state_new, b, statev::void_ratio, k) = point.void_ratio;
  *state(b.state_new, b, statev::plastic_deviatoric_strain, k) = point.plastic_strain;
  *state(b.state_new, b, statev::separation_strain, k) = point.separation_strain;
  *state(b.state_new, b, statev::status, k) = Real(int(status));
}

/// What an update of point k gave, with its energies per mass.
template <class Real, int N>
void store_update(const Update<Real, N>& result, const SymmetricTensor<Real, N>& old_stress,
                  const SymmetricTensor<Real, N>& strain, const Block<Real>& b, int k) {
  if (int(result.status) < 0) return fail(b, N, k, Real(int(result.status)));
  store_point(result.point, result.status, b, k);
  if (result.nonconvex) *state(b.state_new, b, statev::nonconvex_updates, k) += 1;
  if (!(b.density[k] > 0)) return;
  b.internal_new[k] += contract(add(old_stress, Real(1), result.point.stress), strain) / (2 * b.density[k]);
  b.inelastic_new[k] += result.dissipation / b.density[k];
}

template <class Real, int N> void run_point(const Material<Real>& m, const Block<Real>& b, Task task, int k) {
  // A first call or an annealing makes the point from the stress as it was given, and has no strain.
  auto given = load_point<Real, N>(m, b, k), point = given;
  given.stress = load<Real, N>(b.stress_old, b.points, k);
  const auto strain =
      task == Task::annealing ? SymmetricTensor<Real, N>{} : load<Real, N>(b.strain, b.points, k);
  if (!admissible(given, strain)) return fail(b, N, k, Real(int(Status::bad_input)));
  if (task == Task::annealing) {
    store_point(initial_point(m, point.stress, point.void_ratio), Status::elastic, b, k);
    *state(b.state_new, b, statev::nonconvex_updates, k) = 0;
    return;
  }
  if (task == Task::data_check) {
    const auto stress = elastic_stress(m, point, strain);
    store_point(point, Status::elastic, b, k);
    store(stress, b.stress_new, b.points, k);
    return;
  }
  store_update(update(m, point, strain), point.stress, strain, b, k);
}

} // namespace simsand
