// SPDX-License-Identifier: BSD-3-Clause
// The search for one unknown of mixed control, on functions whose root is known.
#include "calibration/radial_strain_search.hpp"
#include <gtest/gtest.h>

using calibration::RadialStrainSearch;

namespace {

constexpr double root = -3.1e-4, axial = 1e-3;

/// Trials until the residual is below 1e-9 of its scale; 50: not found.
template <class Residual> int trials_to_root(RadialStrainSearch search, const Residual& residual) {
  while (search.trials < 50 && std::abs(residual(search.trial)) > 1e-9)
    search.next(residual(search.trial), axial);
  EXPECT_LT(std::abs(residual(search.trial)), 1e-9);
  return search.trials;
}

TEST(RadialStrainSearch, ALinearResidualTakesOneStepWithItsSlopeAndTwoWithoutOne) {
  const auto linear = [](double x) { return 2e3 * (x - root); };
  RadialStrainSearch known;
  known.slope = 2e3;
  EXPECT_EQ(trials_to_root(known, linear), 1);
  EXPECT_EQ(trials_to_root({}, linear), 2);
}

// Stiffness changes a hundredfold at the root, as where an elastic branch meets a plastic one.
TEST(RadialStrainSearch, AKinkIsBracketed) {
  const auto kinked = [](double x) { return (x > root ? 2e3 : 2e1) * (x - root); };
  for (const double slope : {0.0, 2e1, 2e3, 1e6}) {
    RadialStrainSearch search;
    search.slope = slope;
    EXPECT_LE(trials_to_root(search, kinked), 15) << slope;
  }
}

} // namespace
