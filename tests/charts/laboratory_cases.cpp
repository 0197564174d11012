// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/cases.hpp"
#include "tests/charts/rates.hpp"
#include <random>

namespace charts {
namespace {

constexpr double very_loose = 0.9; ///< void ratio, looser than critical

double void_ratio(const Sand& sand, int density) {
  return density == 0 ? sand.dense : density == 1 ? sand.loose : very_loose;
}

/// A state on the yield surface: deviator along `n` (q = 1), this share of the strength mobilised.
Point state_at(const Material& m, double p, double e, const Tensor& n, double share) {
  const auto M = simsand::slopes(m, e, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(n, 1.));
  return {simsand::add_mean(simsand::scale(p * M.peak * share, n), p), e, m.given.k_p * share / (1 - share),
          0};
}

Tensor unit(int component) {
  Tensor t;
  t[component] = 1;
  return t;
}

/// Strain `given` and as much of the `free` components as keep the rates of their stresses 0: Newton's rule, as the
/// plastic rate is linear in the strain.
Tensor holding_stress(const Material& m, const Point& at, Tensor given, const std::vector<int>& free) {
  const auto rate = [&](const Tensor& strain) { return plastic_rate(local(m, at, strain), strain).stress; };
  for (int pass = 0; pass < 20; ++pass) {
    for (const int c : free) { // one after the other: the moduli are positive
      const double now = rate(given)[c], slope = rate(simsand::add(given, 1e-3, unit(c)))[c] - now;
      given[c] -= 1e-3 * now / slope;
    }
  }
  return given;
}

struct Test {
  Tensor stress; ///< deviator of the stress
  Tensor strain;
  std::vector<int> free; ///< components of strain whose stress is held
};

Test test_of(const std::string& path) {
  const Tensor compression{{2. / 3, -1. / 3, -1. / 3}};
  const Tensor sheared = unit_deviator(Tensor{{-0.4, 0.8, -0.4, 0.6}});
  if (path == "drained compression") return {compression, {{1, -0.3, -0.3}}, {1, 2}};
  if (path == "drained extension") return {simsand::scale(-1., compression), {{-1, 0.3, 0.3}}, {1, 2}};
  if (path == "undrained compression") return {compression, {{1, -0.5, -0.5}}, {}};
  if (path == "true triaxial") return {unit_deviator(Tensor{{1, 0, -1}}), {{1, 0, -0.6}}, {1, 2}};
  if (path == "simple shear, constant volume") return {sheared, {{0, 0, 0, 1}}, {}};
  return {sheared, {{0, 0, 0, 1}}, {1}}; // constant normal stress
}

template <class Generator> Tensor random_tensor(Generator& random) {
  std::normal_distribution<double> normal;
  Tensor t;
  for (int c = 0; c < 6; ++c) t[c] = normal(random) * (c < 3 ? 1 : std::sqrt(0.5));
  return simsand::scale(1 / norm(t), t);
}

/// Increments in all directions, a new one each time, from a state on the surface or half way to it.
Case random_case(const Material& m, Case c, double share, int count, std::mt19937_64& random) {
  c.start = state_at(m, c.pressure, c.start.void_ratio, unit_deviator(random_tensor(random)), share);
  if (random() % 2)
    c.start.stress = simsand::add_mean(simsand::scale(0.5, simsand::deviator(c.start.stress)), c.pressure);
  for (int i = 0; i < count; ++i) c.strain.push_back(simsand::scale(c.increment, random_tensor(random)));
  return c;
}

Case test_case(const Material& m, Case c, double share, int count) {
  const auto test = test_of(c.path);
  c.start = state_at(m, c.pressure, c.start.void_ratio, test.stress, share);
  auto direction = test.strain;
  if (!test.free.empty()) direction = holding_stress(m, c.start, direction, test.free);
  c.strain.assign(count, simsand::scale(c.increment / norm(direction), direction));
  return c;
}

} // namespace

std::vector<Case> laboratory_cases(const CaseChoice& choice, double increment) {
  std::vector<Case> cases;
  std::mt19937_64 random(17);
  const int count = std::clamp(int(0.1 / increment + 0.5), 1, choice.increments);
  for (int sand = 0; sand < int(sands.size()); ++sand) {
    const auto m = material_of(properties(sands[sand]));
    for (const auto& path : path_names)
      for (int density = 0; density < int(density_names.size()); ++density)
        for (const double pressure : choice.pressures)
          for (const double share : choice.stages) {
            Case c{sand, path, density_names[density], pressure, increment, {}, {}};
            c.start.void_ratio = void_ratio(sands[sand], density);
            cases.push_back(path == "random" ? random_case(m, c, share, count, random)
                                             : test_case(m, c, share, count));
          }
  }
  return cases;
}

} // namespace charts
