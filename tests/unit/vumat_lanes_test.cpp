// SPDX-License-Identifier: BSD-3-Clause
// Points side by side: the functions of lanes against the standard library, lanes against one point alone, and a
// million points through the calling convention.
#include "tests/unit/vumat_fixture.hpp"
#include "vumat/rescue.hpp"
#include <functional>
#include <gtest/gtest.h>

namespace {

using namespace vumat_test;
namespace statev = simsand::statev;

template <class T> using Lane = simsand::Lanes<T>;

/// Largest relative error of a function of lanes, each lane with an argument of its own.
template <class T, class F, class G, class Sample>
double largest_error(int count, const F& of_lanes, const G& exact, const Sample& sample) {
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    Lane<T> x;
    for (int k = 0; k < simsand::lane_count<T>; ++k) x.set(k, T(sample(i + k)));
    const Lane<T> y = of_lanes(x);
    for (int k = 0; k < simsand::lane_count<T>; ++k) {
      const double expected = exact(double(x[k]));
      if (expected != 0) largest = std::max(largest, std::abs((double(y[k]) - expected) / expected));
    }
  }
  return largest;
}

TEST(VumatLanes, ExpAndLogAreAsGoodAsTheirPrecision) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto check = [&](auto precision, double range, double error) {
    using T = decltype(precision);
    const auto exp_of = [](const Lane<T>& x) { return exp(x); };
    const auto log_of = [](const Lane<T>& x) { return log(x); };
    const auto any = [&](int i) { return std::pow(10, -6 * (i % 3)) * range * uniform(random); };
    const auto positive = [&](int i) { return i % 2 ? std::exp(any(0)) : 1 + any(i) / (2 * range); };
    EXPECT_LT(largest_error<T>(
                  200000, exp_of, [](double x) { return std::exp(x); }, any),
              error);
    EXPECT_LT(largest_error<T>(
                  200000, log_of, [](double x) { return std::log(x); }, positive),
              error);
    EXPECT_EQ(exp(Lane<T>(T(0)))[0], T(1));
    EXPECT_EQ(log(Lane<T>(T(1)))[0], T(0));
  };
  check(0.0, 700, 5e-16);
  check(0.0f, 80, 4e-7);
}

TEST(VumatLanes, SelectMinMaxAbsAndSqrtActOnEachLane) {
  Lane<double> a, b;
  for (int k = 0; k < simsand::lane_count<double>; ++k) {
    a.set(k, k % 2 ? 1.0 + k : -2.0 * k);
    b.set(k, 3.0 - k);
  }
  for (int k = 0; k < simsand::lane_count<double>; ++k) {
    EXPECT_EQ(select(a < b, a, b)[k], std::min(a[k], b[k]));
    EXPECT_EQ(max(a, b)[k], std::max(a[k], b[k]));
    EXPECT_EQ(min(a, b)[k], std::min(a[k], b[k]));
    EXPECT_EQ(sqrt(abs(a))[k], std::sqrt(std::abs(a[k])));
    EXPECT_EQ((a < b)[k], a[k] < b[k]);
  }
  EXPECT_FALSE(all(a < a));
  EXPECT_TRUE(all(!(a < a)));
}

/// Points of any state and increment: void ratio 0.2 to 2, mean stress 0 to 1 MPa, strain 1e-8 to 1e-1.
Block anything(const Shape& shape, std::mt19937_64& random) {
  constexpr int points = 128;
  Block b(points, 3, props(shape, 0.6));
  std::uniform_real_distribution<double> uniform;
  const auto power = [&](double from, double to) {
    return std::pow(10, from + (to - from) * uniform(random));
  };
  for (int k = 0; k < points; ++k) {
    const double p = k % 19 == 0 ? 0 : k % 2 ? 1e6 * uniform(random) : power(-2, 6);
    const double q = (k % 11 == 0 ? 3 : 1) * p * uniform(random), length = power(-8, -1);
    const double volume = k % 5 == 0 ? 0 : length * (2 * uniform(random) - 1);
    const auto s = random_deviator(random), d = random_deviator(random);
    for (int c = 0; c < 6; ++c) {
      b.stress_old[c * points + k] = -(q * s[c] + (c < 3 ? p : 0));
      b.strain[c * points + k] = -(length * d[c] + (c < 3 ? volume / 3 : 0));
    }
    b.state_old[statev::void_ratio * points + k] = k % 23 == 0 ? 0 : 0.2 + 1.8 * uniform(random);
    b.state_old[statev::plastic_deviatoric_strain * points + k] = k % 13 == 0 ? 0 : power(-6, 0);
    b.state_old[statev::separation_strain * points + k] = k % 17 == 0 ? power(-8, -1) : 0;
  }
  return b;
}

/// Point k of the new arrays or the old ones.
State6 state_of(const std::vector<double>& stress, const std::vector<double>& state, int points, int k) {
  State6 out;
  for (int c = 0; c < 6; ++c) out.stress[c] = -stress[c * points + k];
  out.void_ratio = state[statev::void_ratio * points + k];
  out.plastic_strain = state[statev::plastic_deviatoric_strain * points + k];
  out.separation_strain = state[statev::separation_strain * points + k];
  return out;
}

TEST(VumatLanes, AMillionStatesStayAdmissibleAndDoNotKnowTheirBlock) {
  std::mt19937_64 random(31);
  for (int block = 0; block < 7813; ++block) {
    const Shape& shape = shapes[block % 3];
    const auto m = material(shape);
    Block b = anything(shape, random);
    b.call();
    for (int k = 0; k < b.points; ++k) {
      const auto after = state_of(b.stress_new, b.state_new, b.points, k);
      const double p = mean(after.stress);
      ASSERT_GE(b.state(statev::status, k), 0) << block << ' ' << k;
      ASSERT_TRUE(p >= 0 && std::isfinite(p + q_of(after.stress) + after.void_ratio + b.inelastic_new[k]));
      ASSERT_GE(b.inelastic_new[k], 0);
      ASSERT_LE(yield_of(m, after), 1e-6 * p) << block << ' ' << k;
    }
    if (block % 16) continue;
    for (int k = 0; k < b.points; ++k) {
      Block one(1, 3, b.properties);
      for (int c = 0; c < 6; ++c) {
        one.strain[c] = b.strain[c * b.points + k];
        one.stress_old[c] = b.stress_old[c * b.points + k];
      }
      for (int c = 0; c < b.states; ++c) one.state_old[c] = b.state_old[c * b.points + k];
      one.call();
      for (int c = 0; c < 6; ++c) ASSERT_EQ(one.stress_new[c], b.stress_new[c * b.points + k]);
      for (int c = 0; c < b.states; ++c) ASSERT_EQ(one.state_new[c], b.state(c, k));
      ASSERT_EQ(one.internal_new[0], b.internal_new[k]);
      ASSERT_EQ(one.inelastic_new[0], b.inelastic_new[k]);
    }
  }
}

/// An update of point k of a block by itself.
using PointUpdate = std::function<simsand::Update<double, 6>(const simsand::Material<double>&, const State6&,
                                                             const Tensor6&)>;

/// Compares blocks with updates point by point: void ratios, and stresses to 1e-9 where no substep is taken. Where the
/// error of a step lies at its limit, one may cut it and the other not: a share of at most `differently_cut`.
void agrees(const PointUpdate& update, double differently_cut) {
  std::mt19937_64 random(32);
  int compared = 0, cut = 0;
  double largest = 0;
  for (int block = 0; block < 600; ++block) {
    Block b = anything(shapes[block % 3], random);
    const auto m = simsand::Material<double>(parameters_of(shapes[block % 3], 0.6));
    b.call();
    for (int k = 0; k < b.points; ++k) {
      const auto old = state_of(b.stress_old, b.state_old, b.points, k);
      if (old.void_ratio == 0) continue;
      Tensor6 strain;
      for (int c = 0; c < 6; ++c) strain[c] = -b.strain[c * b.points + k];
      const auto alone = update(m, old, strain);
      if (int(alone.status) != b.state(statev::status, k)) {
        ++cut;
        continue;
      }
      if (alone.status == simsand::Status::substepped) continue;
      const auto after = state_of(b.stress_new, b.state_new, b.points, k);
      const double scale = mean(alone.state.stress) + mean(old.stress);
      for (int c = 0; c < 6; ++c)
        largest = std::max(largest, std::abs(after.stress[c] - alone.state.stress[c]) / scale);
      ASSERT_NEAR(after.void_ratio, alone.state.void_ratio, 1e-14);
      ++compared;
    }
  }
  EXPECT_LT(largest, 1e-9);
  EXPECT_GT(compared, 20000);
  EXPECT_LE(cut, compared * differently_cut);
}

TEST(VumatLanes, RegistersAgreeWithOnePointAlone) {
  // The same functions, with exp and log of the standard library, fused otherwise.
  agrees(simsand::update<double, 6>, 0);
}

TEST(VumatLanes, TheUpdateAgreesWithTheRescue) {
  // Newton's rule by series against the bracket, where both solve a point.
  agrees(
      [](const auto& m, const State6& old, const Tensor6& strain) {
        simsand::IncrementProgress<double, 6> at;
        simsand::begin_increment(at, old, strain);
        simsand::rescue(m, at);
        return simsand::Update<double, 6>{at.state, simsand::Status(int(at.status)), 0, false};
      },
      1. / 200);
}

} // namespace
