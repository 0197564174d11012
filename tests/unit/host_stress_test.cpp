// SPDX-License-Identifier: BSD-3-Clause
// The stress stage: what the material is shown, what becomes of its answer, and who is blamed.
#include "host/material/corotational.hpp"
#include "host/scheme/geometry.hpp"
#include "host/scheme/rotation.hpp"
#include "tests/unit/host_stages.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <limits>
#include <omp.h>
#include <random>

namespace {

using namespace host;
using host_test::Stages;

constexpr double young = 4e6, poisson = 0.2, dt = 1e-4; // Pa, -, s

Material elastic() {
  return {load_vumat(SIMSAND_BINARY_DIR "/test_vumats/libelastic.so"), "ELASTIC", {young, poisson}, 1};
}

/// Particles and the velocity gradients, 1/s, that they are strained with.
template <class Geometry> struct Strained {
  Particles<Geometry> p;
  Stages<Geometry> stages{p};

  void set_gradient(int component, double value) {
    stages.velocity_gradient[component].assign(p.padded(), value);
  }
  void set_no_gradient() {
    for (auto& g : stages.velocity_gradient) g.assign(p.padded(), 0.0);
  }
};

template <class Geometry> Strained<Geometry> random_particles(int count) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  Strained<Geometry> out;
  auto& p = out.p;
  p.resize(count, 1);
  out.stages = Stages<Geometry>(p);
  for (int i = 0; i < count; ++i) {
    p.id[i] = 1000 + i;
    p.position[0][i] = 0.01 + 1e-4 * i;
    p.position[1][i] = 0.02;
    for (auto& v : p.velocity) v[i] = normal(random);
    for (auto& g : out.stages.velocity_gradient) g[i] = normal(random);
    for (auto& s : p.stress) s[i] = 1e3 * normal(random);
    p.density[i] = 1500 + 10 * normal(random);
  }
  return out;
}

/// A material whose stress stays; NaN for points at x = props[0] or beyond, in the array props[1] names.
void stays(const int* nblock, const int*, const int* nshr, const int*, const int*, const int*, const int*,
           const double*, const double*, const double*, const char*, const double* coordinates, const double*,
           const double* props, const double*, const double*, const double*, const double*, const double*,
           const double*, const double*, const double* old, const double*, const double*, const double*,
           const double*, const double*, const double*, const double*, double* stress, double* state, double*,
           double*, std::size_t) {
  std::copy_n(old, *nblock * (3 + *nshr), stress);
  for (int k = 0; k < *nblock; ++k)
    if (coordinates[k] >= props[0])
      (props[1] == 0 ? stress[3 * *nblock + k] : state[k]) = std::numeric_limits<double>::quiet_NaN();
}

Material staying(double nan_from = 1e9, double in_state = 0) {
  return {{"stays", nullptr, stays}, "STAYS", {nan_from, in_state}, 1};
}

/// Keeps the stress, and writes to defgradNew, an input, in a call that is not compared.
void scribbles(const int* nblock, const int*, const int* nshr, const int*, const int*, const int*, const int*,
               const double*, const double*, const double*, const char*, const double*, const double*,
               const double*, const double*, const double*, const double*, const double*, const double*,
               const double*, const double*, const double* old, const double*, const double*, const double*,
               const double*, const double*, const double* gradient, const double*, double* stress, double*,
               double*, double*, std::size_t) {
  static int calls = 0;
  std::copy_n(old, *nblock * (3 + *nshr), stress);
  if (++calls == 18) const_cast<double*>(gradient)[3 * *nblock] += 1;
}

template <class Geometry> void update(Strained<Geometry>& s, const Material& material, double time = dt) {
  auto blocks = make_stress_blocks(material, s.p, 0.002);
  update_stress(s.p, material, {time, time, dt}, blocks, s.stages);
}

TEST(Stress, TurnsWithTheMaterial) {
  auto s = random_particles<PlaneStrain>(70);
  const auto& p = s.p;
  const auto before = p;
  const double angle = 0.1; // per step, from axis 1 to axis 2
  s.set_no_gradient();
  s.set_gradient(2, angle / dt);
  s.set_gradient(1, -angle / dt);
  for (int step = 0; step < 7; ++step) update(s, staying());
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(7 * angle).toRotationMatrix();
  for (int i = 0; i < p.count; ++i) {
    Eigen::Matrix2d expected;
    expected << before.stress[0][i], before.stress[3][i], before.stress[3][i], before.stress[1][i];
    expected = turn * expected * turn.transpose();
    EXPECT_NEAR(p.stress[0][i], expected(0, 0), 1e-9);
    EXPECT_NEAR(p.stress[1][i], expected(1, 1), 1e-9);
    EXPECT_NEAR(p.stress[3][i], expected(0, 1), 1e-9);
    EXPECT_EQ(p.stress[2][i], before.stress[2][i]);
    EXPECT_EQ(p.density[i], before.density[i]);
  }
}

Eigen::Matrix3d full(const std::array<Array, 6>& s, int i) {
  Eigen::Matrix3d m;
  m << s[0][i], s[3][i], s[5][i], s[3][i], s[1][i], s[4][i], s[5][i], s[4][i], s[2][i];
  return m;
}

/// Turned about a common axis by `angle` in each of seven steps: whole turns of any size leave no error.
void expect_turned(double angle) {
  auto s = random_particles<ThreeDimensional>(70);
  const auto& p = s.p;
  const auto before = p;
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized(), w = axis * angle / dt;
  const double spin[9] = {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
  for (int e = 0; e < 9; ++e) s.set_gradient(e, spin[e]);
  for (int step = 0; step < 7; ++step) update(s, staying());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(7 * angle, axis).toRotationMatrix();
  for (int i = 0; i < p.count; ++i) {
    const Eigen::Matrix3d expected = turn * full(before.stress, i) * turn.transpose();
    EXPECT_LT((full(p.stress, i) - expected).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(p.density[i], before.density[i]);
  }
}

TEST(Stress, TurnsWithTheMaterialInThreeDimensions) {
  for (const double angle : {1e-7, 0.02, 0.0999, 0.1001, 0.9}) expect_turned(angle);
}

TEST(Stress, AboutTheThirdAxisBothRotationsAgree) {
  const std::array<double, 4> plane{-900, -1100, -1000, 60};
  for (const double angle : {0.01, 1.3}) {
    const auto two = rotated(plane, std::array{angle});
    const auto three =
        rotated(std::array{plane[0], plane[1], plane[2], plane[3], 0., 0.}, std::array{0., 0., angle});
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(three[c], two[c], 1e-10);
  }
}

TEST(Stress, OfLinearElasticityInThreeDimensions) {
  auto s = random_particles<ThreeDimensional>(197);
  const auto& p = s.p;
  auto& gradient = s.stages.velocity_gradient;
  for (int a = 0; a < 3; ++a) // no spin
    for (int b = 0; b < a; ++b) gradient[3 * a + b] = gradient[3 * b + a];
  const auto before = p;
  update(s, elastic());
  const double twice_g = young / (1 + poisson), lambda = twice_g * poisson / (1 - 2 * poisson);
  for (int i = 0; i < p.count; ++i) {
    Eigen::Matrix3d strain;
    for (int e = 0; e < 9; ++e) strain(e / 3, e % 3) = gradient[e][i] * dt;
    const Eigen::Matrix3d expected =
        full(before.stress, i) + twice_g * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
    EXPECT_LT((full(p.stress, i) - expected).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(Stress, OfLinearElasticityIsHookesLaw) {
  auto s = random_particles<Axisymmetric>(197);
  const auto& p = s.p;
  auto& g = s.stages.velocity_gradient;
  g[2] = g[1]; // no spin
  const auto before = p;
  update(s, elastic());
  const double twice_g = young / (1 + poisson), lambda = twice_g * poisson / (1 - 2 * poisson);
  for (int i = 0; i < p.count; ++i) {
    const double strain[4] = {g[0][i] * dt, g[3][i] * dt, before.velocity[0][i] / before.position[0][i] * dt,
                              g[1][i] * dt};
    const double volume = strain[0] + strain[1] + strain[2];
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(p.stress[c][i], before.stress[c][i] + twice_g * strain[c] + (c < 3 ? lambda * volume : 0),
                  1e-8);
    EXPECT_NEAR(p.density[i], before.density[i] * std::exp(-volume),
                0.1 * std::abs(std::pow(volume, 3)) * 1500);
    EXPECT_EQ(p.state[0][i], 1) << "one call";
  }
}

TEST(Stress, DoesNotDependOnThreadsOrOnTheBlock) {
  const int threads = omp_get_max_threads(), count = 5 * StressBlocks::points + 17;
  auto one = random_particles<Axisymmetric>(count), three = one;
  const auto start = one;
  omp_set_num_threads(1);
  update(one, elastic());
  omp_set_num_threads(3);
  update(three, elastic());
  omp_set_num_threads(threads);
  EXPECT_EQ(one.p.stress, three.p.stress);
  EXPECT_EQ(one.p.density, three.p.density);
  EXPECT_EQ(one.p.internal_energy, three.p.internal_energy);

  for (const int i : {0, 63, 64, 200, count - 1}) { // alone in a block of one
    auto alone = random_particles<Axisymmetric>(1);
    for (int a = 0; a < 2; ++a) {
      alone.p.position[a][0] = start.p.position[a][i];
      alone.p.velocity[a][0] = start.p.velocity[a][i];
    }
    for (int c = 0; c < 4; ++c) {
      alone.p.stress[c][0] = start.p.stress[c][i];
      alone.stages.velocity_gradient[c][0] = start.stages.velocity_gradient[c][i];
    }
    alone.p.density[0] = start.p.density[i];
    update(alone, elastic());
    for (int c = 0; c < 4; ++c) EXPECT_EQ(alone.p.stress[c][0], one.p.stress[c][i]);
    EXPECT_EQ(alone.p.internal_energy[0], one.p.internal_energy[i]);
  }
}

std::string error_of_update(Strained<PlaneStrain>& s, const Material& material, double time) {
  try {
    update(s, material, time);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

/// Shows the material what it has of strain as stress.
void shows_strain(const int* nblock, const int*, const int* nshr, const int*, const int*, const int*,
                  const int*, const double*, const double*, const double*, const char*, const double*,
                  const double*, const double*, const double*, const double* strain, const double*,
                  const double*, const double*, const double*, const double*, const double*, const double*,
                  const double*, const double*, const double*, const double*, const double*, const double*,
                  double* stress, double*, double*, double*, std::size_t) {
  std::copy_n(strain, *nblock * (3 + *nshr), stress);
}

TEST(Stress, WhatIsThrownOffIsNotStrainedFurtherApart) {
  constexpr double rate = 10; // 1/s, in each of the three directions
  struct Case {
    const char* name;
    double density, rate, stress;
    bool kept;
  };
  for (const auto& c :
       {Case{"thrown off", 600, rate, 0, true}, Case{"it comes together", 600, -rate, 0, false},
        Case{"loose", 800, rate, 0, false}, Case{"it bears", 600, rate, -1e4, false},
        Case{"it holds together", 600, rate, 1e4, false}}) {
    auto strained = random_particles<ThreeDimensional>(70);
    auto& p = strained.p;
    for (int s = 0; s < 6; ++s) p.stress[s].assign(p.padded(), s < 3 ? c.stress : 0);
    strained.set_no_gradient();
    for (const int e : {0, 4, 8}) strained.set_gradient(e, c.rate);
    strained.set_gradient(1, 2 * rate);
    p.density.assign(p.padded(), c.density);
    p.wave_speed.assign(p.padded(), 40); // constrained modulus 960 kPa
    auto blocks = make_stress_blocks(elastic(), p, 0.002);
    blocks.dispersed_density = 750;
    const Material shown{{"shows_strain", nullptr, shows_strain}, "SHOWN", {0.0}, 0};
    update_stress(p, shown, {dt, dt, dt}, blocks, strained.stages);
    const double strain = c.kept ? 0 : c.rate * dt;
    for (int i = 0; i < p.count; ++i) {
      for (int s = 0; s < 3; ++s) EXPECT_NEAR(p.stress[s][i], strain, 1e-15) << c.name;
      EXPECT_NEAR(p.stress[3][i], rate * dt, 1e-15) << c.name; // shear goes on
      EXPECT_NEAR(p.density[i], c.density * std::exp(-3 * strain), 3e-9 * c.density) << c.name; // third order
    }
  }
}

TEST(Stress, WhatIsThrownOffInThePlaneIsNotStrainedOutOfIt) {
  constexpr double rate = 10, density = 600;
  auto strained = random_particles<PlaneStrain>(70);
  auto& p = strained.p;
  for (auto& a : p.stress) a.assign(a.size(), 0.0);
  strained.set_no_gradient();
  strained.set_gradient(0, 3 * rate);
  strained.set_gradient(3, rate);
  p.density.assign(p.padded(), density);
  auto blocks = make_stress_blocks(elastic(), p, 0.002);
  blocks.dispersed_density = 750;
  const Material shown{{"shows_strain", nullptr, shows_strain}, "SHOWN", {0.0}, 0};
  update_stress(p, shown, {dt, dt, dt}, blocks, strained.stages);
  for (int i = 0; i < p.count; ++i) {
    EXPECT_NEAR(p.stress[0][i], rate * dt, 1e-15); // what changes the shape goes on
    EXPECT_NEAR(p.stress[1][i], -rate * dt, 1e-15);
    EXPECT_EQ(p.stress[2][i], 0);
    EXPECT_NEAR(p.density[i], density, 1e-12 * density);
  }
}

TEST(Stress, NamesTheFirstParticleWithoutANumber) {
  for (const int first : {0, 3, 64, 150, 196})
    for (const double in_state : {0, 1}) {
      auto strained = random_particles<PlaneStrain>(197);
      auto& p = strained.p;
      for (auto& s : p.stress) s.assign(s.size(), 0.0);
      p.stress[1].assign(p.padded(), -1234);
      strained.set_no_gradient();
      strained.set_gradient(0, 20);
      const double from = p.position[0][first];
      const auto error = error_of_update(strained, staying(from, in_state), 0.375);
      const auto says = [&](const std::string& part) { return error.find(part) != std::string::npos; };
      EXPECT_TRUE(says("STAYS")) << error;
      EXPECT_TRUE(says("particle " + std::to_string(1000 + first) + " at time 0.375 s")) << error;
      EXPECT_TRUE(says("(0, -1234, 0, 0) Pa")) << error;
      EXPECT_TRUE(says("(0.002, 0, 0, 0)")) << error;
      EXPECT_EQ(error.find('\n'), std::string::npos);
      EXPECT_TRUE(std::isfinite(p.stress[3][first])) << "the last good stress stays";
    }
}

TEST(Stress, ASubroutineCannotBendTheDeformationGradient) {
  Material material{{"scribbles", nullptr, scribbles}, "SCRIBBLES", {}, 1};
  material.frame = Frame::green_naghdi;
  auto strained = random_particles<PlaneStrain>(10);
  auto& p = strained.p;
  strained.set_no_gradient();
  carry_deformation(p);
  auto blocks = make_stress_blocks(material, p, 0.002);
  for (int k = 1; k <= 20; ++k) update_stress(p, material, {k * dt, k * dt, dt}, blocks, strained.stages);
  for (int i = 0; i < p.count; ++i) EXPECT_EQ(p.deformation_gradient[3][i], 0) << i;
}

TEST(Stress, WaveSpeedIsThatOfUniaxialStrain) {
  auto p = random_particles<PlaneStrain>(197).p;
  const auto before = p;
  const auto material = elastic();
  auto blocks = make_stress_blocks(material, p, 0.002);
  update_wave_speed(p, material, blocks);
  const double bulk = young / (3 * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
  for (int i = 0; i < p.count; ++i)
    EXPECT_NEAR(p.wave_speed[i], std::sqrt((bulk + 4 * shear / 3) / p.density[i]), 1e-6);
  EXPECT_EQ(p.stress, before.stress) << "a question, not a step";
  EXPECT_EQ(p.state, before.state);
}

/// A material whose stress grows by its own amount times the strain: wave speeds are those of the stress.
void stiffens(const int* nblock, const int*, const int* nshr, const int*, const int*, const int*, const int*,
              const double*, const double*, const double*, const char*, const double*, const double*,
              const double*, const double*, const double* strain, const double*, const double*, const double*,
              const double*, const double*, const double* old, const double*, const double*, const double*,
              const double*, const double*, const double*, const double*, double* stress, double*, double*,
              double*, std::size_t) {
  for (int c = 0; c < *nblock * (3 + *nshr); ++c) stress[c] = old[c] * (1 - strain[c]);
}

TEST(Stress, WaveSpeedIsAskedForWhereTheStressHasChanged) {
  const Material material{{"stiffens", nullptr, stiffens}, "STIFFENS", {}, 1};
  auto p = random_particles<ThreeDimensional>(197).p;
  p.stress[0].assign(p.padded(), -1000);
  for (int c = 1; c < 6; ++c) p.stress[c].assign(p.padded(), 0);
  auto blocks = make_stress_blocks(material, p, 0.002);
  blocks.wave_speed_tolerance = 0.1;
  update_wave_speed(p, material, blocks);
  const auto first = p.wave_speed;
  const auto expected = [&](int i) { return std::sqrt(-p.stress[0][i] / p.density[i]); };
  for (int i = 0; i < p.count; ++i) EXPECT_NEAR(first[i], expected(i), 1e-6 * first[i]);

  for (int i = 0; i < p.count; ++i) p.stress[0][i] *= i % 3 == 0 ? 1.05 : (i % 3 == 1 ? 1.5 : 0.5);
  update_wave_speed(p, material, blocks, 5);
  for (int i = 0; i < p.count; ++i) {
    if (i % 3 == 0 && (i / lanes + 5) % 16 != 0)
      EXPECT_EQ(p.wave_speed[i], first[i]);
    else
      EXPECT_NEAR(p.wave_speed[i], expected(i), 1e-6 * first[i]);
  }
  for (int step = 6; step < 21; ++step) update_wave_speed(p, material, blocks, step);
  for (int i = 0; i < p.count; ++i) EXPECT_NEAR(p.wave_speed[i], expected(i), 1e-6 * first[i]);
}

} // namespace
