// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmark/random_states.hpp"
#include "vumat/simsand.hpp"
#include <cmath>
#include <random>

namespace benchmark {
namespace {

using Tensor = simsand::SymmetricTensor<double, 6>;

/// A deviator of any direction with q = 1.
Tensor random_deviator(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Tensor s;
  for (int c = 0; c < 6; ++c) s[c] = normal(random);
  s = simsand::deviator(s);
  return simsand::scale(1 / simsand::deviatoric_stress(s), s);
}

std::vector<double> tension_positive(const Tensor& t) {
  std::vector<double> out(6);
  for (int c = 0; c < 6; ++c) out[c] = -t[c];
  return out;
}

} // namespace

States random_states(int count, std::array<double, 2> decades) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  const auto power = [&](double from, double to) {
    return std::pow(10, from + (to - from) * uniform(random));
  };
  States states{{100, 0.2, 0.51, 18.5, 0.76, 0.04, 0.3, 1, 0.0015, 3.3, 1, 0.58, 101325, 0}, 3, {}};
  simsand::Parameters<double> parameters;
  simsand::read_props(states.properties.data(), int(states.properties.size()), parameters);
  const simsand::Material<double> material(parameters);
  for (int k = 0; k < count; ++k) {
    const double p = power(std::log10(50), std::log10(2000)), q = p * 0.6 * uniform(random);
    const double length = power(decades[0], decades[1]), volume = 0.3 * length * (2 * uniform(random) - 1);
    const Tensor s = random_deviator(random), d = random_deviator(random);
    const Tensor stress = simsand::add_mean(simsand::scale(q, s), p);
    const Tensor strain = simsand::add_mean(simsand::scale(length / 2, simsand::add(s, 1., d)), volume / 3);
    const double e = 0.58 + 0.22 * uniform(random);
    const double eps_d = simsand::initial_state(material, stress, e).plastic_strain;
    states.updates.push_back({tension_positive(stress), tension_positive(strain), {e, eps_d, 0, 0, 0}, 1600});
  }
  return states;
}

} // namespace benchmark
