// SPDX-License-Identifier: BSD-3-Clause
// The VUMAT: blocks, strides, component order and the turn of sign, and no physics. Arguments: abi.hpp.
// Failure is never silent: STATEV(4) is negative (simsand.hpp, Status) and the stress is NaN.
#include "vumat/abi.hpp"
#include "vumat/simsand.hpp"

namespace simsand {
namespace {

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

template <class Real, int N> void run_point(const Material<Real>& m, const Block<Real>& b, Task task, int k) {
  const auto strain = load<Real, N>(b.strain, b.points, k);
  auto point = load_point<Real, N>(m, b, k);
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
  const auto old_stress = point.stress;
  const auto result = update(m, point, strain);
  if (int(result.status) < 0) return fail(b, N, k, Real(int(result.status)));
  store_point(result.point, result.status, b, k);
  if (result.nonconvex) *state(b.state_new, b, statev::nonconvex_updates, k) += 1;
  if (!(b.density[k] > 0)) return;
  b.internal_new[k] += contract(add(old_stress, Real(1), result.point.stress), strain) / (2 * b.density[k]);
  b.inelastic_new[k] += result.dissipation / b.density[k];
}

template <class Real>
void run(const Block<Real>& b, int direct, int shear, const Real* props, int prop_count, Task task) noexcept {
  keep_old(b);
  Parameters<Real> parameters;
  const PropsError refused = read_props(props, prop_count, parameters);
  const bool supported =
      direct == 3 && (shear == 1 || shear == 3) && b.state_count >= int(state_variables.size());
  if (!supported || refused.entry) {
    const int code = supported ? int(Status::bad_property) - refused.entry : int(Status::unsupported);
    for (int k = 0; k < b.points; ++k) fail(b, direct + shear, k, Real(code));
    return;
  }
  const Material<Real> material(parameters);
  for (int k = 0; k < b.points; ++k)
    if (shear == 1)
      run_point<Real, 4>(material, b, task, k);
    else
      run_point<Real, 6>(material, b, task, k);
}

} // namespace
} // namespace simsand

extern "C" __attribute__((visibility("default"))) void
vumat_(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* /*nfieldv*/,
       const int* nprops, const int* lanneal, const double* stepTime, const double* totalTime,
       const double* /*dt*/, const char* /*cmname*/, const double* /*coordMp*/, const double* /*charLength*/,
       const double* props, const double* density, const double* strainInc, const double* /*relSpinInc*/,
       const double* /*tempOld*/, const double* /*stretchOld*/, const double* /*defgradOld*/,
       const double* /*fieldOld*/, const double* stressOld, const double* stateOld,
       const double* enerInternOld, const double* enerInelasOld, const double* /*tempNew*/,
       const double* /*stretchNew*/, const double* /*defgradNew*/, const double* /*fieldNew*/,
       double* stressNew, double* stateNew, double* enerInternNew, double* enerInelasNew,
       std::size_t /*cmname_length*/) noexcept {
  using namespace simsand;
  // lanneal may be an array since 2023: its first entry means the same.
  const Task task = *lanneal == 1                         ? Task::annealing
                    : (*stepTime == 0 && *totalTime == 0) ? Task::data_check
                                                          : Task::increment;
  const Block<double> block{*nblock,       *nstatev,      density,   strainInc, stressOld,     stateOld,
                            enerInternOld, enerInelasOld, stressNew, stateNew,  enerInternNew, enerInelasNew};
  run(block, *ndir, *nshr, props, *nprops, task);
}
