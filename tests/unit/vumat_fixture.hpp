// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the material share: the parameter sets of the three grain shapes and one block of arrays
// for calls through the ABI.
#pragma once
#include "vumat/abi.hpp"
#include "vumat/simsand.hpp"
#include <array>
#include <random>
#include <vector>

extern "C" vumat::Subroutine<double> vumat_;

namespace vumat_test {

using Tensor6 = simsand::SymmetricTensor<double, 6>;
using State6 = simsand::SoilState<double, 6>;

inline constexpr double p_at = 101325; // Pa

/// Spheres, tetrahedra, elongated grains.
struct Shape {
  double phi, e_ref, dense;
};
inline constexpr Shape SS{18.5, 0.76, 0.58}, TS{24, 0.76, 0.44}, ES{26, 0.74, 0.448};
inline constexpr std::array shapes{SS, TS, ES};

inline std::vector<double> props(const Shape& shape, double e0) {
  return {100, 0.2, 0.51, shape.phi, shape.e_ref, 0.04, 0.3, 1, 0.0015, 3.3, 1, e0, p_at, 0};
}

inline simsand::Parameters<double> parameters_of(const Shape& shape, double e0) {
  simsand::Parameters<double> out{};
  const auto values = props(shape, e0);
  simsand::read_props(values.data(), int(values.size()), out);
  return out;
}

inline simsand::Material<double> material(const Shape& shape) {
  return simsand::Material<double>(parameters_of(shape, shape.dense));
}

inline Tensor6 isotropic(double pressure) {
  return simsand::add_mean(Tensor6{}, pressure);
}

inline double mean(const Tensor6& stress) {
  return simsand::trace(stress) / 3;
}

inline double q_of(const Tensor6& stress) {
  return simsand::deviatoric_stress(simsand::deviator(stress));
}

/// A deviator of random direction with q = 1.
template <class Generator> Tensor6 random_deviator(Generator& random) {
  std::normal_distribution<double> normal;
  Tensor6 s;
  for (int c = 0; c < 6; ++c) s[c] = normal(random);
  s = simsand::deviator(s);
  return simsand::scale(1 / simsand::deviatoric_stress(s), s);
}

/// Yield function (8) of a point as a host could evaluate it.
inline double yield_of(const simsand::Material<double>& m, const State6& point) {
  const auto s = simsand::deviator(point.stress);
  const double p = mean(point.stress), q = simsand::deviatoric_stress(s);
  const auto M =
      simsand::slopes(m, point.void_ratio, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(s, q));
  return simsand::yield_function(q, p, M.peak, simsand::mobilised(m, point.plastic_strain));
}

/// Arrays of a block and the call. Component c of point k lies at [c * points + k], tension positive.
struct Block {
  Block(int points_, int shear_, std::vector<double> props_)
      : points(points_), shear(shear_), properties(std::move(props_)) {
    const std::size_t n = points;
    for (auto* a : {&strain, &stress_old, &stress_new}) a->assign(n * (3 + shear), 0);
    for (auto* a : {&state_old, &state_new}) a->assign(n * states, 0);
    for (auto* a : {&internal_old, &internal_new, &inelastic_old, &inelastic_new}) a->assign(n, 0);
    density.assign(n, 1600);
  }

  void call() {
    const int fields = 0, constants = int(properties.size());
    std::vector<int> info(8 + points, -1); // only the first entry of arguments 7 and 10 may be read
    std::vector<double> steps(2 * points + 1, std::numeric_limits<double>::quiet_NaN());
    info[0] = annealing;
    steps[0] = 1e-5;
    const std::array<char, vumat::name_length> name{};
    vumat_(&points, &direct, &shear, &states, &fields, &constants, info.data(), &time, &time, steps.data(),
           name.data(), nullptr, nullptr, properties.data(), density.data(), strain.data(), nullptr, nullptr,
           nullptr, nullptr, nullptr, stress_old.data(), state_old.data(), internal_old.data(),
           inelastic_old.data(), nullptr, nullptr, nullptr, nullptr, stress_new.data(), state_new.data(),
           internal_new.data(), inelastic_new.data(), name.size());
  }

  /// Makes the new values the old ones.
  void advance() {
    stress_old = stress_new;
    state_old = state_new;
    internal_old = internal_new;
    inelastic_old = inelastic_new;
  }

  double state(int index, int k = 0) const { return state_new[std::size_t(index) * points + k]; }

  int points, direct = 3, shear, states = int(simsand::state_variables.size()), annealing = 0;
  double time = 1;
  std::vector<double> properties;
  std::vector<double> density, strain, stress_old, stress_new, state_old, state_new;
  std::vector<double> internal_old, internal_new, inelastic_old, inelastic_new;
};

} // namespace vumat_test
