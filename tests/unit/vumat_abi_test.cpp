// SPDX-License-Identifier: BSD-3-Clause
// The shell: what a host sees of the material through the calling convention.
#include "tests/unit/vumat_fixture.hpp"
#include <cstring>
#include <gtest/gtest.h>
#include <thread>

namespace {

using namespace vumat_test;
namespace statev = simsand::statev;

/// A block of points under different pressures and strains, some yielding, some parted.
Block various(int points, int shear) {
  Block b(points, shear, props(SS, 0.58));
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  for (int k = 0; k < points; ++k) {
    const double p = 20 * (k + 1);
    for (int c = 0; c < 3; ++c) b.stress_old[c * points + k] = -p * (1 + 0.1 * c);
    for (int c = 0; c < 3 + shear; ++c) b.strain[c * points + k] = 1e-4 * normal(random) - (c < 3) * 2e-5;
  }
  return b;
}

TEST(VumatAbi, OnePointAtATimeEqualsTheBlockBitForBit) {
  for (const int shear : {1, 3}) {
    Block all = various(128, shear);
    for (int step = 0; step < 5; ++step) {
      all.call();
      for (int k = 0; k < 128; ++k) {
        Block one(1, shear, all.properties);
        const auto pick = [&](const std::vector<double>& from, std::vector<double>& to) {
          for (std::size_t c = 0; c < to.size(); ++c) to[c] = from[c * 128 + k];
        };
        pick(all.strain, one.strain);
        pick(all.stress_old, one.stress_old);
        pick(all.state_old, one.state_old);
        pick(all.internal_old, one.internal_old);
        pick(all.inelastic_old, one.inelastic_old);
        one.call();
        for (int c = 0; c < 3 + shear; ++c) ASSERT_EQ(one.stress_new[c], all.stress_new[c * 128 + k]);
        for (int c = 0; c < one.states; ++c) ASSERT_EQ(one.state_new[c], all.state_new[c * 128 + k]);
        ASSERT_EQ(one.internal_new[0], all.internal_new[k]);
        ASSERT_EQ(one.inelastic_new[0], all.inelastic_new[k]);
      }
      all.advance();
    }
  }
}

TEST(VumatAbi, PlaneStrainEqualsSpaceWithoutOutOfPlaneShear) {
  Block plane = various(16, 1), space(16, 3, plane.properties);
  std::copy(plane.strain.begin(), plane.strain.end(), space.strain.begin());
  std::copy(plane.stress_old.begin(), plane.stress_old.end(), space.stress_old.begin());
  plane.call();
  space.call();
  for (int i = 0; i < 4 * 16; ++i) EXPECT_NEAR(plane.stress_new[i], space.stress_new[i], 1e-9);
}

TEST(VumatAbi, SignOrderAndShearConvention) {
  // Each component of strain alone, on an elastic point: tension positive, shear as tensor components.
  for (int c = 0; c < 6; ++c) {
    Block b(1, 3, props(SS, 0.58));
    for (int i = 0; i < 3; ++i) b.stress_old[i] = -1000;
    b.state_old = {0.58, 0.1, 0, 0, 0};
    b.strain[c] = 1e-8;
    b.call();
    const double K = 100 * p_at * 2.39 * 2.39 / 1.58 * std::pow(1000 / p_at, 0.51), G = 0.75 * K;
    for (int i = 0; i < 6; ++i) {
      const double direct = i < 3 && c < 3 ? K - 2 * G / 3 : 0, own = i == c ? 2 * G : 0;
      EXPECT_NEAR(b.stress_new[i] - b.stress_old[i], (direct + own) * 1e-8, 1e-4 * G * 1e-8) << i << c;
    }
  }
}

TEST(VumatAbi, DataCheckIsIsotropicElasticWithTheMaterialInPlace) {
  Block b(1, 3, props(SS, 0.58));
  b.time = 0;
  for (int i = 0; i < 3; ++i) b.stress_old[i] = -2000;
  b.strain = {0.1, -0.2, 0.3, 0.1, 0, 0.05}; // fictitious: large, and beyond any strength
  b.call();
  const double K = 100 * p_at * 2.39 * 2.39 / 1.58 * std::pow(2000 / p_at, 0.51), G = 0.75 * K, dv = 0.2;
  for (int c = 0; c < 6; ++c) {
    const double expected = (c < 3 ? -2000 + (K - 2 * G / 3) * dv : 0) + 2 * G * b.strain[c];
    EXPECT_NEAR(b.stress_new[c], expected, 1e-9 * K);
  }
  EXPECT_EQ(b.state(statev::status), 0);
  EXPECT_EQ(b.state(statev::separation_strain), 0);
}

TEST(VumatAbi, FirstCallTakesTheInitialVoidRatioAndAGeostaticStress) {
  Block b(1, 1, props(SS, 0.58));
  b.stress_old = {-500, -1000, -500, 0};
  b.call();
  EXPECT_EQ(b.state(statev::void_ratio), 0.58);
  const double p = 2000. / 3, q = 500;
  const auto m = material(SS);
  const double M = simsand::slopes(m, 0.58, simsand::pressure_of_mean_stress(m, p), -1.).peak;
  EXPECT_NEAR(b.state(statev::plastic_deviatoric_strain), 0.0015 * (q / p) / (M - q / p), 1e-12);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(b.stress_new[c], b.stress_old[c], 1e-9);
}

TEST(VumatAbi, AnnealingForgetsThePlasticStrainAndKeepsStressAndVoidRatio) {
  Block b(1, 3, props(SS, 0.58));
  for (int i = 0; i < 3; ++i) b.stress_old[i] = -1000;
  b.state_old = {0.65, 0.2, 0, 1, 7};
  b.strain[3] = 1e-3;
  b.annealing = 1;
  b.internal_old[0] = b.inelastic_old[0] = 3;
  b.call();
  EXPECT_EQ(b.state(statev::void_ratio), 0.65);
  for (const int zero : {statev::plastic_deviatoric_strain, statev::separation_strain, statev::status,
                         statev::nonconvex_updates})
    EXPECT_EQ(b.state(zero), 0);
  EXPECT_EQ(b.stress_new, b.stress_old);
  EXPECT_EQ(b.internal_new[0], 3);
}

TEST(VumatAbi, EnergiesArePerMassAndDissipationIsNeverNegative) {
  Block b = various(128, 3);
  for (int step = 0; step < 20; ++step) {
    b.call();
    for (int k = 0; k < 128; ++k) {
      double work = 0;
      for (int c = 0; c < 6; ++c)
        work +=
            (c < 3 ? 1 : 2) * (b.stress_old[c * 128 + k] + b.stress_new[c * 128 + k]) * b.strain[c * 128 + k];
      EXPECT_NEAR(b.internal_new[k] - b.internal_old[k], work / (2 * 1600), 1e-12);
      EXPECT_GE(b.inelastic_new[k], b.inelastic_old[k]);
    }
    b.advance();
    for (double& e : b.strain) e = step % 3 == 0 ? -e : e;
  }
}

TEST(VumatAbi, DissipationApproachesTheWorkOfLongShearing) {
  // At the critical state the elastic strain is constant: all work is dissipated.
  Block b(1, 3, props(SS, 0.7));
  b.stress_old = {-20000, -20000, -20000, 0, 0, 0};
  b.strain[3] = 1e-4;
  for (int step = 0; step < 20000; ++step) {
    b.call();
    b.advance();
  }
  const double work = b.internal_old[0], dissipated = b.inelastic_old[0];
  for (int step = 0; step < 1000; ++step) {
    b.call();
    b.advance();
  }
  EXPECT_NEAR((b.inelastic_old[0] - dissipated) / (b.internal_old[0] - work), 1, 1e-3);
}

TEST(VumatAbi, RefusedPropertiesAndShapesAreSeenByEveryHost) {
  const auto failed = [](Block& b, double code) {
    b.call();
    for (int k = 0; k < b.points; ++k) {
      EXPECT_EQ(b.state(statev::status, k), code);
      for (int c = 0; c < 3 + b.shear; ++c) EXPECT_TRUE(std::isnan(b.stress_new[c * b.points + k]));
      EXPECT_EQ(b.state(statev::void_ratio, k), 0.6);
    }
  };
  for (int entry = 1; entry <= 13; ++entry) {
    Block b(3, 3, props(SS, 0.58));
    std::fill_n(b.state_old.begin(), 3, 0.6);
    b.properties[entry - 1] = -1;
    failed(b, -100 - entry);
  }
  Block few(3, 1, {100, 0.2});
  std::fill_n(few.state_old.begin(), 3, 0.6);
  failed(few, -103);
  Block membrane(3, 1, props(SS, 0.58));
  std::fill_n(membrane.state_old.begin(), 3, 0.6);
  membrane.direct = 2;
  membrane.call();
  EXPECT_EQ(membrane.state(statev::status, 1), -3);
  Block broken(1, 3, props(SS, 0.58));
  broken.state_old[0] = 0.6;
  broken.strain[0] = std::numeric_limits<double>::quiet_NaN();
  failed(broken, -2);
}

/// Not a number, infinite or impossible, in a first call, an increment, a data check and an annealing call.
TEST(VumatAbi, BadNumbersAreRefusedByEveryTask) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  constexpr int points = 20, bad_point = 11;
  const auto good = [](bool first_call, bool data_check, bool annealing) {
    Block b(points, 3, props(SS, 0.58));
    b.time = data_check ? 0 : 1;
    b.annealing = annealing;
    for (int k = 0; k < points; ++k) {
      for (int c = 0; c < 3; ++c) b.stress_old[c * points + k] = -1000 - k;
      b.strain[k] = -1e-5;
      if (!first_call) b.state_old[k] = 0.6;
    }
    return b;
  };
  const auto refuses = [&](const Block& b, std::vector<double> Block::*array, int entry, double value) {
    Block with = b, without = b;
    (with.*array)[std::size_t(entry) * points + bad_point] = value;
    with.call();
    without.call();
    for (int c = 0; c < 6; ++c)
      for (int k = 0; k < points; ++k)
        if (k == bad_point)
          EXPECT_TRUE(std::isnan(with.stress_new[c * points + k])) << entry << " " << value;
        else
          EXPECT_EQ(with.stress_new[c * points + k], without.stress_new[c * points + k]);
    EXPECT_EQ(with.state(statev::status, bad_point), -2) << entry << " " << value;
    for (const int s : {statev::void_ratio, statev::plastic_deviatoric_strain, statev::separation_strain})
      EXPECT_EQ(
          std::memcmp(&with.state_new[s * points + bad_point], &with.state_old[s * points + bad_point], 8),
          0);
  };
  for (const bool annealing : {false, true})
    for (const bool data_check : {false, true})
      for (const bool first_call : {false, true}) {
        const Block b = good(first_call, data_check, annealing);
        for (const double bad : {nan, infinite, -infinite})
          for (int c = 0; c < 6; ++c) {
            refuses(b, &Block::stress_old, c, bad);
            if (!annealing) refuses(b, &Block::strain, c, bad);
          }
        for (const double bad : {nan, -0.5}) refuses(b, &Block::state_old, statev::void_ratio, bad);
        if (first_call) continue; // the rest of the state is not looked at
        for (const double bad : {nan, -1e-3})
          refuses(b, &Block::state_old, statev::plastic_deviatoric_strain, bad);
        refuses(b, &Block::state_old, statev::separation_strain, nan);
      }
}

/// Increments far beyond use: the void ratio is that of the volume, or the point fails.
TEST(VumatAbi, VoidRatioOfHugeIncrements) {
  for (const double strain : {-50., -1., 0.4, 3., 20., 2000.}) {
    Block b(16, 3, props(SS, 0.58));
    for (int k = 0; k < 16; ++k) {
      for (int c = 0; c < 3; ++c) {
        b.stress_old[c * 16 + k] = -1000;
        b.strain[c * 16 + k] = strain / 3;
      }
      b.state_old[k] = 0.6;
    }
    b.call();
    for (int k = 0; k < 16; ++k) {
      const double e = std::max(1.6 * std::exp(strain) - 1, 0.01);
      if (!std::isfinite(e))
        EXPECT_EQ(b.state(statev::status, k), -1);
      else if (b.state(statev::status, k) >= 0)
        EXPECT_NEAR(b.state(statev::void_ratio, k), e, 1e-14 * (1 + e));
      else
        EXPECT_LT(strain, -1) << "may fail in compression only";
    }
  }
}

TEST(VumatAbi, StatesBeyondItsOwnAreHandedThrough) {
  Block b(2, 3, props(SS, 0.58));
  b.states = 8;
  b.state_old.assign(16, 0);
  b.state_new.assign(16, -1);
  for (int k = 0; k < 2; ++k)
    for (int c = 0; c < 3; ++c) {
      b.state_old[(5 + c) * 2 + k] = 10 * c + k;
      b.stress_old[c * 2 + k] = -1000;
    }
  b.call();
  for (int k = 0; k < 2; ++k)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(b.state(5 + c, k), 10 * c + k);
}

TEST(VumatAbi, ThreadsDoNotMeet) {
  Block alone = various(128, 3);
  alone.call();
  std::vector<Block> blocks(8, various(128, 3));
  std::vector<std::thread> threads;
  for (Block& b : blocks)
    threads.emplace_back([&b] {
      for (int i = 0; i < 50; ++i) b.call();
    });
  for (auto& t : threads) t.join();
  for (const Block& b : blocks) {
    EXPECT_EQ(b.stress_new, alone.stress_new);
    EXPECT_EQ(b.state_new, alone.state_new);
  }
}

} // namespace
