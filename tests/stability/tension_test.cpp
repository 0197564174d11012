// SPDX-License-Identifier: BSD-3-Clause
// Tensile instability (Swegle, Hicks and Attaway 1995). Sand bears no tension, so the product never meets it; a material
// that does, meets it here as in any scheme of this kind: a boundary of the method, kept with its numbers.
#include "tests/stability/bodies.hpp"
#include "tests/stability/naive_scheme.hpp"
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace stability;
using Simulation = host::Simulation<host::PlaneStrain>;

const auto product = [](Simulation& s) { host::step(s); };
const auto naive = [](Simulation& s) { naive_step(s); };

/// Kinetic energy of noise in elastic particles under a uniform stress, Pa, tension positive, after 20 ms or 15 crossings
/// of waves; over that at the start. 12 x 12 particles move within a frame of four rows that stand still.
double growth(double stress) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(-1e-4, 1e-4); // m/s
  const auto moves = [](Place x) { return std::max(std::abs(x[0]), std::abs(x[1])) < 0.015; };
  auto s = make_body(
      0.0025, 0.025, [](Place x) { return std::max(std::abs(x[0]), std::abs(x[1])) < 0.025; },
      [&](Place x) {
        return moves(x) ? Place{noise(random), noise(random)} : Place{};
      });
  auto& p = s.particles;
  const stability::Places lattice(p);
  for (int c = 0; c < 3; ++c) p.stress[c].assign(p.padded(), stress);
  const double start = host::kinetic_energy(p);
  double most = 0;
  while (s.time < 0.02) {
    host::step(s);
    for (int i = 0; i < p.count; ++i)
      if (!moves(lattice.of(p, i)))
        for (int a = 0; a < 2; ++a) {
          p.position[a][i] = lattice.of(p, i)[a];
          p.velocity[a][i] = 0;
        }
    if (s.time > 0.018) most = std::max(most, host::kinetic_energy(p) / start);
  }
  return most;
}

TEST(Tension, NoiseDiesUnderCompressionAndGrowsUnderTension) {
  std::vector<double> grown;
  for (const double stress : {-3e4, 0., 1e3, 1e4}) {
    grown.push_back(growth(stress));
    std::printf("stress / E = %+.3f: kinetic energy of the noise times %.3g\n", stress / 1e6, grown.back());
  }
  for (const int k : {0, 1, 2}) EXPECT_LT(grown[k], 0.1);
  EXPECT_GT(grown[3], 1e3)
      << "a boundary of the method: if it holds now, tests/charts/STABILITY.md is to be changed";
}

/// The time at which two next neighbours are half as far apart again, s; `until` if they never are.
template <class Step> double time_of_crack(Simulation s, double until, Step&& step) {
  const stability::Places lattice(s.particles);
  double next = 0;
  while (s.time < until) {
    step(s);
    if (s.time < next) continue;
    next += until / 100;
    if (bonds_of(s, lattice).longest > 1.5) return s.time;
  }
  return until;
}

TEST(Tension, ARotatingElasticSquareComesApart) {
  constexpr double turn = 300; // 1/s: 2.8 % of stretch at the centre
  const auto square = [] {
    return make_body(
        0.0025, 0.025, [](Place x) { return std::max(std::abs(x[0]), std::abs(x[1])) < 0.025; },
        [](Place x) {
          return Place{-turn * x[1], turn * x[0]};
        });
  };
  const double period = 2 * std::numbers::pi / turn;
  const double ours = time_of_crack(square(), 0.03, product) / period,
               other = time_of_crack(square(), 0.03, naive) / period;
  std::printf("cracked after %.2f turns, naive %.2f\n", ours, other);
  EXPECT_LT(ours, 1);
  EXPECT_LT(other, 1);
}

TEST(Tension, CollidingElasticRingsComeApart) {
  constexpr double apart = 0.0425, speed = 2; // m, m/s
  const auto rings = [] {
    return make_body(
        0.002, 0.085,
        [](Place x) {
          const double r = std::hypot(std::abs(x[0]) - apart, x[1]);
          return r > 0.03 && r < 0.04;
        },
        [](Place x) {
          return Place{x[0] > 0 ? -speed : speed, 0};
        });
  };
  const double ours = time_of_crack(rings(), 0.015, product), other = time_of_crack(rings(), 0.015, naive);
  std::printf("cracked after %.4f s, naive %.4f s\n", ours, other);
  EXPECT_LT(ours, 0.015);
  EXPECT_LT(other, 0.015);
}

} // namespace
