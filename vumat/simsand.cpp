// SPDX-License-Identifier: BSD-3-Clause
#include "vumat/simsand.hpp"
#include "vumat/rescue.hpp"

namespace simsand {

template <class T>
Material<T>::Material(const Parameters<T>& parameters)
    : given(parameters), shear_ratio(T(1.5) * (1 - 2 * given.nu) / (1 + given.nu)), // (2)
      tan_phi(std::tan(given.phi * T(0.017453292519943295))), floor_pressure(given.p_min / given.p_at),
      floor_stiffness(std::pow(floor_pressure, given.n)), floor_measure(floor_pressure / floor_stiffness) {}

template <class T, int N>
SoilState<T, N> initial_state(const Material<T>& m, const SymmetricTensor<T, N>& stress, T e) {
  constexpr T largest_mobilised = T(0.99);
  SoilState<T, N> state{stress, e, 0, 0};
  const T p = trace(stress) / 3;
  if (!(p > 0)) return {{}, e, 0, 0};
  const auto s = deviator(stress);
  const T q = deviatoric_stress(s);
  const auto M = slopes(m, e, pressure_of_mean_stress(m, p), sin_3theta(s, q));
  const T h = std::min(q / (p * M.peak), largest_mobilised);
  state.plastic_strain = m.given.k_p * h / (1 - h); // (8) = 0
  return state;
}

template <class T, int N>
SymmetricTensor<T, N> elastic_stress(const Material<T>& m, const SoilState<T, N>& state,
                                     const SymmetricTensor<T, N>& strain_increment) {
  const T K = bulk_modulus(m, state.void_ratio, pressure_of_mean_stress(m, trace(state.stress) / 3));
  return add_mean(add(state.stress, 2 * m.shear_ratio * K, deviator(strain_increment)),
                  K * trace(strain_increment));
}

template <class T, int N>
Update<T, N> update(const Material<T>& m, const SoilState<T, N>& old,
                    const SymmetricTensor<T, N>& strain_increment) noexcept {
  if (!is_admissible(old, strain_increment)) return {old, Status::bad_input, 0, false};
  SubstepWorkspace<T, N> w{};
  RegisterGroup<T, N> one;
  one.add(w);
  begin_increment(w, old, strain_increment);
  try_first(m, one);
  try_plastic(m, one);
  while (w.status >= 0 && w.applied < 1) {
    try_elastic(m, one);
    try_plastic(m, one);
  }
  if (w.status < 0) {
    begin_increment(w, old, strain_increment);
    rescue<T, N>(m, w);
  }
  if (w.status < 0) return {old, Status::exhausted, 0, false};
  return {w.state, Status(int(w.status)), w.dissipation, w.nonconvex > 0};
}

#define SIMSAND_INSTANTIATE(T, N)                                                                            \
  template SoilState<T, N> initial_state(const Material<T>&, const SymmetricTensor<T, N>&, T);               \
  template SymmetricTensor<T, N> elastic_stress(const Material<T>&, const SoilState<T, N>&,                  \
                                                const SymmetricTensor<T, N>&);                               \
  template Update<T, N> update(const Material<T>&, const SoilState<T, N>&,                                   \
                               const SymmetricTensor<T, N>&) noexcept;
template struct Material<float>;
template struct Material<double>;
SIMSAND_INSTANTIATE(float, 4)
SIMSAND_INSTANTIATE(float, 6)
SIMSAND_INSTANTIATE(double, 4)
SIMSAND_INSTANTIATE(double, 6)
#undef SIMSAND_INSTANTIATE

} // namespace simsand
