// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/cycles.hpp"
#include <random>

namespace charts {
namespace {

/// Integral of p dy from p = 0: p^2 / 2 over the constant stiffness below p_min, a power above.
double pressure_energy(const Material& m, double p) {
  const double ratio = p / m.given.p_at, n = m.given.n, floor = m.floor_pressure;
  const double below = std::min(ratio, floor), above = std::max(ratio, floor);
  return m.given.p_at * (below * below / (2 * m.floor_stiffness) +
                         (std::pow(above, 2 - n) - std::pow(floor, 2 - n)) / (2 - n));
}

struct Energies {
  double volume, shear, log_G, log_g;
};

Energies energies(const Material& m, const Point& point) {
  const double p = std::max(mean(point.stress), 0.), g = simsand::void_ratio_factor(point.void_ratio);
  const double G =
      m.shear_ratio * simsand::bulk_modulus(m, point.void_ratio, simsand::pressure_of_mean_stress(m, p));
  const double q = simsand::deviatoric_stress(simsand::deviator(point.stress));
  return {pressure_energy(m, p) / (m.given.K0 * g), q * q / (6 * G), std::log(G), std::log(g)};
}

} // namespace

double stored_energy(const Material& m, const Point& point) {
  const auto a = energies(m, point);
  return a.volume + a.shear;
}

CycleEnergy lead_through(const Material& m, Point& point, const std::vector<Tensor>& corners, int parts,
                         int cycles) {
  CycleEnergy sum;
  const double before = stored_energy(m, point);
  const double eps_before = point.plastic_strain;
  for (int side = 0; side < cycles * int(corners.size()); ++side) {
    const auto& from = corners[side % corners.size()];
    const auto& to = corners[(side + 1) % corners.size()];
    const auto part = simsand::scale(1. / parts, simsand::add(to, -1., from));
    for (int k = 0; k < parts; ++k) {
      const auto next = simsand::update(m, point, part);
      if (int(next.status) < 0) {
        sum.failed = true;
        return sum;
      }
      const double work = simsand::contract(simsand::add(point.stress, 1., next.state.stress), part) / 2;
      const auto a = energies(m, point), b = energies(m, next.state);
      sum.work += work;
      sum.gross += std::abs(work);
      sum.dissipation += next.dissipation;
      sum.defect +=
          (a.shear + b.shear) / 2 * (b.log_G - a.log_G) + (a.volume + b.volume) / 2 * (b.log_g - a.log_g);
      point = next.state;
    }
  }
  sum.stored = stored_energy(m, point) - before;
  sum.plastic_strain = point.plastic_strain - eps_before;
  return sum;
}

RandomCycle random_cycle(std::uint64_t number, double amplitude) {
  std::mt19937_64 random(number + 1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    Tensor t;
    for (int c = 0; c < 6; ++c) t[c] = normal(random) * (c < 3 ? 1 : std::sqrt(0.5));
    return simsand::scale(1 / norm(t), t);
  };
  RandomCycle cycle{int(number % 3), {}, {Tensor{}}};
  const auto m = material_of(properties(sands[cycle.sand]));
  const double p = std::pow(10, 6 * uniform(random)), e = 0.45 + 0.4 * uniform(random);
  const double share = 0.98 * uniform(random); // of the strength, mobilised
  const auto n = unit_deviator(direction());
  const auto M = simsand::slopes(m, e, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(n, 1.));
  cycle.start = {simsand::add_mean(simsand::scale(p * M.peak * share * uniform(random), n), p), e,
                 m.given.k_p * share / (1 - share), 0};
  const int corners = 3 + int(6 * uniform(random));
  for (int i = 1; i < corners; ++i)
    cycle.corners.push_back(simsand::scale(amplitude * uniform(random), direction()));
  return cycle;
}

} // namespace charts
