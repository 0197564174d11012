// SPDX-License-Identifier: BSD-3-Clause
// The integrators of the charts and their reference: gradients against differences of the yield function, the
// reference against the product in many substeps, orders of convergence, unloading, separation.
#include "tests/charts/integrators.hpp"
#include "tests/charts/reference.hpp"
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace charts;

Material sand(int i) {
  return material_of(properties(sands[i]));
}

Tensor random_tensor(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Tensor t;
  for (int c = 0; c < 6; ++c) t[c] = normal(random);
  return simsand::scale(1 / norm(t), t);
}

/// On the yield surface along a random deviator, half of the strength mobilised.
Point yielding(const Material& m, double p, double e, const Tensor& direction) {
  const auto n = unit_deviator(direction);
  const auto M = simsand::slopes(m, e, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(n, 1.));
  return {simsand::add_mean(simsand::scale(p * M.peak / 2, n), p), e, m.given.k_p, 0};
}

double error(const Point& a, const Point& exact) {
  return norm(simsand::add(a.stress, -1., exact.stress)) / norm(exact.stress);
}

TEST(Rates, GradientsAreThoseOfTheYieldFunction) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const auto m = sand(i % 3);
    const double p = std::pow(10, 1 + i % 5);
    const Point at = yielding(m, p, i % 2 ? 0.5 : 0.8, random_tensor(random));
    const auto strain = random_tensor(random);
    const auto here = local(m, at, strain);
    const auto elastic = elastic_rate(here, strain), plastic = plastic_rate(here, strain);
    const double h = 1e-5 * p / here.G;
    const auto slope = [&](const Rate& r) {
      return (yield_of(m, moved(at, h, r)) - yield_of(m, moved(at, -h, r))) / (2 * h);
    };
    EXPECT_NEAR(slope(elastic), elastic_growth(here, strain), 1e-6 * here.G);
    if (plastic.eps_d > 0) { // consistency: f stays 0
      EXPECT_NEAR(slope(plastic), 0, 1e-5 * here.G);
    }
  }
}

TEST(Reference, TheProductConvergesToIt) {
  std::mt19937_64 random(2);
  int plastic = 0;
  for (int i = 0; i < 60; ++i) {
    const auto m = sand(i % 3);
    const Point start = yielding(m, std::pow(10, 1 + i % 4), i % 2 ? 0.55 : 0.8, random_tensor(random));
    const auto strain = simsand::scale(std::pow(10, -6 + i % 3), random_tensor(random));
    const auto exact = integrate_rates(m, start, strain);
    ASSERT_TRUE(exact.found);
    const auto in_substeps = [&](int count) {
      Point at = start;
      for (int k = 0; k < count; ++k) at = simsand::update(m, at, simsand::scale(1. / count, strain)).state;
      return at;
    };
    const Point coarse = in_substeps(4000), fine = in_substeps(16000);
    plastic += exact.point.plastic_strain > start.plastic_strain;
    if (norm(exact.point.stress) == 0) {
      EXPECT_EQ(norm(fine.stress), 0) << i;
      continue;
    }
    EXPECT_LT(error(coarse, exact.point), 2e-5) << i;
    EXPECT_LT(error(fine, exact.point), std::max(error(coarse, exact.point) / 3, 1e-7)) << i;
    EXPECT_NEAR(fine.plastic_strain, exact.point.plastic_strain, 2e-5 * exact.point.plastic_strain) << i;
    EXPECT_NEAR(fine.void_ratio, exact.point.void_ratio, 1e-10) << i;
    EXPECT_LE(yield_of(m, exact.point), 2e-9 * mean(exact.point.stress));
  }
  EXPECT_GT(plastic, 20);
}

TEST(Reference, ItsToleranceIsItsError) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const auto m = sand(i % 3);
    const Point start = yielding(m, 1e3, 0.55, random_tensor(random));
    const auto strain = simsand::scale(1e-3, random_tensor(random));
    const auto loose = integrate_rates(m, start, strain, 1e-7),
               tight = integrate_rates(m, start, strain, 1e-11);
    if (norm(tight.point.stress) == 0) continue;
    EXPECT_LT(error(loose.point, tight.point), 2e-5);
    EXPECT_LT(error(integrate_rates(m, start, strain).point, tight.point), 2e-7);
  }
}

TEST(Reference, GrainsThatPartAndMeetAgain) {
  const auto m = sand(0);
  const Point start{simsand::add_mean(Tensor{}, 1e3), 0.6, 0.01, 0};
  const auto apart = integrate_rates(m, start, simsand::add_mean(Tensor{}, -0.01 / 3)).point;
  EXPECT_EQ(norm(apart.stress), 0);
  EXPECT_GT(apart.separation_strain, 0);
  const auto back = integrate_rates(m, apart, simsand::add_mean(Tensor{}, 0.01 / 3));
  ASSERT_TRUE(back.found);
  EXPECT_NEAR(mean(back.point.stress), 1e3, 1e-3);
}

/// A path on which loading does not stop and nothing vanishes: mostly along the stress, with shear that turns it.
struct Smooth {
  Material m = sand(1);
  Point start = yielding(m, 2e3, 0.5, Tensor{{2, -1, -1}});
  Tensor strain{{4e-4, -2.8e-4, -1e-4, 1e-4, 5e-5, -7e-5}};
  Point exact = integrate_rates(m, start, strain, 1e-12).point;

  template <class Update> double error_in(int parts, const Update& update) const {
    Point at = start;
    for (int i = 0; i < parts; ++i) {
      const Answer answer = update(m, at, simsand::scale(1. / parts, strain));
      EXPECT_TRUE(answer.converged);
      at = answer.point;
    }
    return error(at, exact);
  }
};

TEST(Integrators, ConvergeAtTheirOrder) {
  const Smooth path;
  const auto ratio = [&](auto update) { return path.error_in(200, update) / path.error_in(400, update); };
  for (auto* first_order : {explicit_euler, corrected_euler, backward_euler, cutting_plane}) {
    EXPECT_NEAR(ratio(first_order), 2, 0.15);
    EXPECT_LT(path.error_in(400, first_order), 1e-3);
  }
  // The step that the tolerance leaves free: of second order; with it the error follows the tolerance.
  const auto free = [](const Material& m, const Point& p, const Tensor& e) {
    return modified_euler(m, p, e, 1);
  };
  EXPECT_NEAR(ratio(free), 4, 0.6);
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const auto controlled = [&](const Material& m, const Point& p, const Tensor& e) {
      return modified_euler(m, p, e, tolerance);
    };
    EXPECT_LT(path.error_in(1, controlled), 10 * tolerance);
  }
}

TEST(Integrators, ReturnToTheYieldSurfaceButForTheOneThatDoesNot) {
  const Smooth path;
  const auto drift = [&](const Answer& a) {
    return std::abs(yield_of(path.m, a.point)) / mean(a.point.stress);
  };
  EXPECT_GT(drift(explicit_euler(path.m, path.start, path.strain)), 1e-3);
  for (auto* update : {corrected_euler, backward_euler, cutting_plane})
    EXPECT_LT(drift(update(path.m, path.start, path.strain)), 1e-8);
  EXPECT_LT(drift(modified_euler(path.m, path.start, path.strain, 1e-3)), 1e-8);
}

TEST(Integrators, UnloadElasticallyAndMeetTheOtherSide) {
  const auto m = sand(0);
  const Point start = yielding(m, 1e3, 0.6, Tensor{{2, -1, -1}});
  const Tensor back{{-2e-4, 1e-4, 1e-4}}, little = simsand::scale(0.1, back);
  const double share = elastic_share(m, start, back);
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.9);
  EXPECT_NEAR(yield_of(m, elastic_answer(m, start, simsand::scale(share, back)).point), 0, 1e-6);
  EXPECT_EQ(elastic_share(m, start, little), 1);
  const auto exact = integrate_rates(m, start, little).point;
  for (auto* update : {explicit_euler, corrected_euler, backward_euler, cutting_plane})
    EXPECT_LT(error(update(m, start, little).point, exact), 1e-5);
  EXPECT_LT(error(modified_euler(m, start, back, 1e-5).point, integrate_rates(m, start, back).point), 1e-4);
}

TEST(Integrators, PartWhereTheProductParts) {
  const auto m = sand(0);
  const Point start = yielding(m, 1e3, 0.7, Tensor{{2, -1, -1}});
  const auto opening = simsand::add_mean(Tensor{{1e-4, -1e-4}}, -0.01 / 3);
  const double gap = simsand::update(m, start, opening).state.separation_strain;
  for (auto* update : {explicit_euler, corrected_euler, backward_euler, cutting_plane}) {
    const auto answer = update(m, start, opening);
    EXPECT_TRUE(answer.converged);
    EXPECT_EQ(norm(answer.point.stress), 0);
    EXPECT_NEAR(answer.point.separation_strain, gap, 0.1 * gap);
  }
  EXPECT_EQ(norm(modified_euler(m, start, opening, 1e-3).point.stress), 0);
}

} // namespace
