// SPDX-License-Identifier: BSD-3-Clause
// Pair forces: antisymmetric, adjoint to the velocity gradient, dissipative; diffusion of stress.
#include "host/scheme/damping.hpp"
#include "tests/unit/host_fixture.hpp"
#include <gtest/gtest.h>
#include <omp.h>

namespace {

using namespace host;
using namespace host_test;

Scene scene_without_walls() {
  Scene scene;
  scene.spacing = spacing;
  scene.gravity = 9.81;
  scene.bulk_density = 1500;
  scene.earth_pressure_ratio = 0.5;
  return scene;
}

/// A disordered block away from the axis, with random stress and velocity.
template <class Geometry> Simulation<Geometry> cloud(int columns, int rows, std::uint64_t seed) {
  constexpr int D = Geometry::dimension;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  std::normal_distribution<double> normal;
  auto s = empty_cloud<Geometry>(D == 2 ? columns * rows : columns * columns * rows, scene_without_walls());
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i) {
    if constexpr (D == 2)
      put(p, i,
          {(20 + i % columns + jitter(random)) * spacing, (20 + i / columns + jitter(random)) * spacing});
    else
      put(p, i, in_block<Geometry>(i, columns, 20, random, 0.3));
    for (auto& v : p.velocity) v[i] = normal(random);
    for (auto& stress : p.stress) stress[i] = 1e3 * normal(random);
    p.density[i] = 1500 * (1 + jitter(random));
    p.wave_speed[i] = 30 * (1 + jitter(random));
  }
  arrange(s, spacing, s.kernel.support);
  return s;
}

template <class Geometry> void find_forces(Simulation<Geometry>& s, Stages<Geometry>& stages) {
  show(s);
  write_stress_records(s.particles, s.scene, s.kernel.h, stages, s.records);
  update_acceleration(s.particles, s.kernel, s.lists, s.records, s.scene, stages);
}

/// Power of an acceleration, W, and the sum of the absolute parts of it.
template <class Geometry>
std::array<double, 2> power(const Particles<Geometry>& p,
                            const std::array<Array, Geometry::dimension>& acceleration) {
  double sum = 0, size = 0;
  for (int i = 0; i < p.count; ++i)
    for (int a = 0; a < Geometry::dimension; ++a) {
      const double part = p.mass[i] * acceleration[a][i] * p.velocity[a][i];
      sum += part;
      size += std::abs(part);
    }
  return {sum, size};
}

/// The sum whose adjoint the stress force is: sum_j V_j (v_j - v_i) (x) grad W_ij, component D a + b.
template <class Geometry>
std::array<double, Geometry::dimension * Geometry::dimension> gradient_sum(const Simulation<Geometry>& s,
                                                                           int i) {
  constexpr int D = Geometry::dimension;
  const auto& motion = s.records.motion;
  std::array<double, D * D> sum{};
  for (int j = 0; j < s.particles.count; ++j) {
    double x[D], v[D], square = 0;
    for (int a = 0; a < D; ++a) {
      x[a] = motion[i].position[a] - motion[j].position[a];
      v[a] = motion[j].velocity[a] - motion[i].velocity[a];
      square += x[a] * x[a];
    }
    const double w = motion[j].volume * s.kernel.pair_scale() * s.kernel.pair_shape(square);
    for (int e = 0; e < D * D; ++e) sum[e] += v[e / D] * w * x[e % D];
  }
  return sum;
}

template <class Geometry> void expect_adjoint() {
  constexpr int D = Geometry::dimension;
  auto s = cloud<Geometry>(D == 2 ? 13 : 8, D == 2 ? 11 : 7, 1);
  const auto& p = s.particles;
  auto stages = find_gradients(s);
  find_forces(s, stages);
  double stress_power = 0;
  for (int i = 0; i < p.count; ++i) {
    const auto g = gradient_sum(s, i);
    double power = Geometry::hoop ? p.stress[2][i] * p.velocity[0][i] / p.position[0][i] : 0;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) power += p.stress[component<D>(a, b)][i] * g[D * a + b];
    stress_power += p.mass[i] / p.density[i] * power;
  }
  const auto [by_pairs, size] = power(p, stages.stress_acceleration);
  EXPECT_GT(size, D == 2 ? 1 : 1e-3);
  EXPECT_NEAR(by_pairs, -stress_power, 1e-13 * size);
}

TEST(Momentum, WorkOfPairForcesIsTheStressPowerOfTheGradientSum) {
  expect_adjoint<PlaneStrain>();
  expect_adjoint<Axisymmetric>();
  expect_adjoint<ThreeDimensional>();
}

TEST(Momentum, PairForcesAreAntisymmetric) {
  auto s = cloud<PlaneStrain>(2, 1, 2);
  const auto& p = s.particles;
  auto stages = find_gradients(s);
  find_forces(s, stages);
  for (const auto* acceleration : {&stages.stress_acceleration, &stages.viscous_acceleration})
    for (const auto& a : *acceleration) {
      EXPECT_NE(a[0], 0);
      EXPECT_NEAR(p.mass[0] * a[0], -p.mass[1] * a[1], 1e-14 * std::abs(p.mass[0] * a[0]));
    }
}

template <class Geometry> void expect_momentum_kept(int columns, int rows) {
  auto s = cloud<Geometry>(columns, rows, 3);
  const auto& p = s.particles;
  auto stages = find_gradients(s);
  find_forces(s, stages);
  for (const auto* acceleration : {&stages.stress_acceleration, &stages.viscous_acceleration})
    for (const auto& a : *acceleration) {
      double sum = 0, size = 0;
      for (int i = 0; i < p.count; ++i) {
        sum += p.mass[i] * a[i];
        size += std::abs(p.mass[i] * a[i]);
      }
      EXPECT_GT(size, 0);
      EXPECT_NEAR(sum, 0, 1e-13 * size);
    }
}

TEST(Momentum, OfACloudIsKept) {
  expect_momentum_kept<PlaneStrain>(13, 11);
  expect_momentum_kept<ThreeDimensional>(8, 7);
}

constexpr double single_rounding =
    5.96e-8; // relative, of one operation; the viscosity is in single precision

/// The sums, taken apart for speed, against the formula pair by pair.
TEST(Momentum, InThreeDimensionsIsTheSumOverThePairs) {
  auto s = cloud<ThreeDimensional>(7, 6, 9);
  auto& p = s.particles;
  auto stages = find_gradients(s);
  find_forces(s, stages);
  const auto& n = s.scene.numerics;
  const double h = s.kernel.h;
  for (int i = 0; i < p.count; i += 7) {
    double stress[3]{}, viscous[3]{}, viscous_size[3]{}, diffusion[6]{}, norm = 0;
    const auto speed = [&](int k) {
      double square = 0;
      for (const auto& g : stages.velocity_gradient) square += g[k] * g[k];
      if (k == i) norm = std::sqrt(square);
      return double(float(damping_speed(medium_of(s.scene), h, p.wave_speed[k], std::sqrt(square))));
    };
    const auto density = [&](int k) { return double(float(p.density[k])); };
    const auto rate = [&](int k, int a, int b) {
      const auto g = [&](int e, int f) { return stages.velocity_gradient[3 * e + f][k]; };
      return double(float(a == b ? g(a, a) : g(a, b) + g(b, a)));
    };
    for (int j = 0; j < p.count; ++j) {
      if (j == i) continue;
      double x[3], r2 = 0, whole = 0, linear = 0, largest_part = 0;
      for (int a = 0; a < 3; ++a) {
        x[a] = p.position[a][i] - p.position[a][j];
        r2 += x[a] * x[a];
        whole += (p.velocity[a][i] - p.velocity[a][j]) * x[a];
      }
      const double w = s.kernel.pair_scale() * s.kernel.pair_shape(r2) * p.mass[j] / p.density[j];
      for (int a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b) {
          const double part = 0.5 * (rate(i, a, b) + rate(j, a, b)) * x[a] * x[b];
          linear += part;
          largest_part = std::max(largest_part, std::abs(part));
        }
      const double approach =
          whole > 0 ? std::clamp(whole - linear, 0.0, whole) : std::clamp(whole - linear, whole, 0.0);
      const double scale = 0.25 * (speed(i) + speed(j)) * h * (density(i) + density(j)) / (r2 + 0.01 * h * h);
      const double pressure = scale * approach;
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b)
          stress[a] += (p.stress[component<3>(a, b)][i] + p.stress[component<3>(a, b)][j]) * w * x[b];
        viscous[a] += pressure * w * x[a];
        viscous_size[a] += scale * std::max(std::abs(whole), largest_part) * std::abs(w * x[a]);
      }
      for (int c = 0; c < 6; ++c) {
        const double part = c == 2 ? 1 : (c < 2 ? s.scene.earth_pressure_ratio : 0);
        diffusion[c] += w * (p.stress[c][i] - p.stress[c][j] - part * 1500 * 9.81 * x[2]);
      }
    }
    const double diffusivity = std::min(n.stress_diffusion * h * h * norm, 0.1 * h * p.wave_speed[i]);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(stages.stress_acceleration[a][i], stress[a] / p.density[i], 1e-9);
      EXPECT_NEAR(stages.viscous_acceleration[a][i], viscous[a] / p.density[i],
                  10 * single_rounding * viscous_size[a] / p.density[i]);
    }
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(stages.stress_diffusion[c][i], 2 * diffusivity * diffusion[c],
                  1e-10 * 1e3 * 2 * diffusivity / (h * h));
  }
}

/// Gives all particles the velocity field v = v0 + G x and its gradient.
template <class Geometry>
void move_linearly(Particles<Geometry>& p, Stages<Geometry>& stages, const double (&slope)[4]) {
  for (int i = 0; i < p.count; ++i)
    for (int a = 0; a < 2; ++a) {
      p.velocity[a][i] = 0.3 + slope[2 * a] * p.position[0][i] + slope[2 * a + 1] * p.position[1][i];
      for (int b = 0; b < 2; ++b) stages.velocity_gradient[2 * a + b][i] = slope[2 * a + b];
    }
}

double largest(const std::array<Array, 2>& acceleration, int count) {
  double most = 0;
  for (const auto& a : acceleration)
    for (int i = 0; i < count; ++i) most = std::max(most, std::abs(a[i]));
  return most;
}

TEST(Momentum, ViscosityLeavesALinearFlowAlone) {
  auto s = cloud<Axisymmetric>(13, 11, 4);
  auto& p = s.particles;
  auto stages = find_gradients(s);
  move_linearly(p, stages, {-40, 25, 10, 30});
  find_forces(s, stages);
  const double resolved = largest(stages.viscous_acceleration, p.count);
  for (auto& g : stages.velocity_gradient) g.assign(g.size(), 0.0);
  find_forces(s, stages);
  EXPECT_LT(resolved, 10 * single_rounding * largest(stages.viscous_acceleration, p.count));
}

template <class Geometry> void expect_dissipation() {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1); // hundreds of tiny clouds
  for (int seed = 0; seed < 300; ++seed) {
    constexpr bool solid = Geometry::dimension == 3;
    auto s = seed < 290 ? cloud<Geometry>(2, 1, seed) : cloud<Geometry>(solid ? 6 : 13, solid ? 4 : 11, seed);
    auto& p = s.particles;
    auto stages = find_gradients(s);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, 500); // whatever the gradients are
    for (auto& g : stages.velocity_gradient)
      for (int i = 0; i < p.count; ++i) g[i] = normal(random);
    find_forces(s, stages);
    const auto [sum, size] = power(p, stages.viscous_acceleration);
    EXPECT_LE(sum, 1e-14 * size) << "seed " << seed;
  }
  omp_set_num_threads(threads);
}

TEST(Momentum, ViscosityNeverGivesEnergy) {
  expect_dissipation<PlaneStrain>();
  expect_dissipation<Axisymmetric>();
  expect_dissipation<ThreeDimensional>();
}

/// Rates of stress diffusion in a uniform flow of shear rate 50 / s.
template <class Geometry> Stages<Geometry> find_diffusion(Simulation<Geometry>& s) {
  auto stages = find_gradients(s);
  move_linearly(s.particles, stages, {0, 50, 0, 0});
  find_forces(s, stages);
  return stages;
}

TEST(Momentum, StressDiffusionConservesAndSmooths) {
  auto s = cloud<PlaneStrain>(13, 11, 5);
  s.scene.gravity = 0;
  const auto stages = find_diffusion(s);
  const auto& p = s.particles;
  for (int c = 0; c < 4; ++c) {
    double total = 0, size = 0, change = 0;
    for (int i = 0; i < p.count; ++i) {
      const double rate = p.mass[i] / p.density[i] * stages.stress_diffusion[c][i];
      total += rate;
      size += std::abs(rate);
      change += rate * p.stress[c][i];
    }
    EXPECT_NEAR(total, 0, 1e-13 * size);
    EXPECT_LT(change, 0) << "the sum of squares falls";
  }
}

TEST(Momentum, StressDiffusionIsThatOfTheHeatEquation) {
  // On a lattice, of stress x^2: rate = 2 diffusivity; delta h2 |grad v| of the flow above.
  auto s = cloud<PlaneStrain>(21, 21, 6);
  s.scene.gravity = 0;
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i) {
    for (auto& x : p.position) x[i] = std::round(x[i] / spacing) * spacing;
    p.density[i] = 1500;
    p.stress[0][i] = p.position[0][i] * p.position[0][i];
  }
  const auto stages = find_diffusion(s);
  const double diffusivity = s.scene.numerics.stress_diffusion * s.kernel.h * s.kernel.h * 50;
  int interior = 0;
  for (int i = 0; i < p.count; ++i) {
    if (std::abs(p.position[0][i] / spacing - 30) > 6.5 || std::abs(p.position[1][i] / spacing - 30) > 6.5)
      continue;
    ++interior;
    EXPECT_NEAR(stages.stress_diffusion[0][i], 2 * diffusivity, 0.02 * 2 * diffusivity);
  }
  EXPECT_EQ(interior, 13 * 13);
}

TEST(Momentum, GeostaticStressDoesNotDiffuse) {
  auto s = cloud<PlaneStrain>(13, 11, 7);
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i) {
    const double vertical = -1500 * 9.81 * (0.1 - p.position[1][i]);
    p.stress[0][i] = 0.5 * vertical;
    p.stress[1][i] = vertical;
    p.stress[2][i] = 0.5 * vertical;
    p.stress[3][i] = 7;
  }
  const auto stages = find_diffusion(s);
  const double diffusivity = s.scene.numerics.stress_diffusion * s.kernel.h * s.kernel.h * 50;
  const double rounding = 1e-12 * 1500 * diffusivity / (spacing * spacing);
  for (const auto& rate : stages.stress_diffusion)
    for (int i = 0; i < p.count; ++i) EXPECT_NEAR(rate[i], 0, rounding);
}

} // namespace
