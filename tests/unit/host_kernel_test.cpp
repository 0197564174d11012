// SPDX-License-Identifier: BSD-3-Clause
// The kernels: a partition of unity in two and three dimensions, its slope, its end.
#include "host/scheme/kernel.hpp"
#include <gtest/gtest.h>

namespace {

using namespace host;

constexpr double h = 0.003; // m

class Kernels : public testing::TestWithParam<KernelKind> {};
INSTANTIATE_TEST_SUITE_P(Wendland, Kernels, testing::Values(KernelKind::wendland_c2, KernelKind::wendland_c4),
                         [](const auto& at) { return at.param == KernelKind::wendland_c2 ? "C2" : "C4"; });

/// Simpson's rule over the support; the integrand is a polynomial.
template <class F> double integral(const F& f) {
  constexpr int panels = 4000;
  const double width = 2 * h / panels;
  double sum = f(0.0) + f(2 * h);
  for (int k = 1; k < panels; ++k) sum += (k % 2 ? 4 : 2) * f(k * width);
  return sum * width / 3;
}

TEST_P(Kernels, IntegratesToOne) {
  const Kernel<2> disc(h, GetParam());
  const Kernel<3> ball(h, GetParam());
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(integral([&](double r) { return 2 * pi * r * disc.value(r); }), 1, 1e-12);
  EXPECT_NEAR(integral([&](double r) { return 4 * pi * r * r * ball.value(r); }), 1, 1e-12);
}

TEST_P(Kernels, SecondMomentOfTheSlopeIsOneInEachDirection) {
  // Partial integration: the moment matrix of a complete support is the unit matrix.
  const Kernel<2> disc(h, GetParam());
  const Kernel<3> ball(h, GetParam());
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(integral([&](double r) { return -pi * r * r * r * disc.gradient_factor(r); }), 1, 1e-12);
  EXPECT_NEAR(integral([&](double r) { return -4 * pi / 3 * r * r * r * r * ball.gradient_factor(r); }), 1,
              1e-12);
}

TEST_P(Kernels, SlopeIsThatOfItsValue) {
  const Kernel<2> kernel(h, GetParam());
  for (double r = 0.05 * h; r < 2 * h; r += 0.1 * h) {
    const double step = 1e-4 * h;
    const double difference = (kernel.value(r + step) - kernel.value(r - step)) / (2 * step);
    EXPECT_NEAR(r * kernel.gradient_factor(r), difference, 1e-7 * kernel.alpha / h) << r / h;
  }
  EXPECT_DOUBLE_EQ(kernel.gradient_factor(0.0), kernel.slope);
}

TEST_P(Kernels, OfPairsIsTheSameInSinglePrecision) {
  const Kernel<3> kernel(h, GetParam());
  for (double r = 0; r < 2.5 * h; r += 0.01 * h) {
    const double found = kernel.pair_scale() * kernel.pair_shape(r * r);
    EXPECT_NEAR(found, kernel.gradient_factor(r), -6e-7 * kernel.slope) << r / h; // ten roundings
    if (r > kernel.support * (1 + 1e-6)) {
      EXPECT_EQ(found, 0) << r / h;
    }
  }
  Lane square;
  for (int l = 0; l < lanes; ++l) square[l] = 0.09 * l * l * h * h;
  const auto shapes = kernel.pair_shape(square);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(shapes[l], kernel.pair_shape(double(square[l])));
  EXPECT_EQ(kernel.pair_shape(1e60), 0);
}

TEST_P(Kernels, IsExactlyZeroBeyondItsSupport) {
  const Kernel<2> kernel(h, GetParam());
  for (const double r : {kernel.support * (1 + 1e-15), 2.001 * h, 1.0, 1e30}) {
    EXPECT_EQ(kernel.value(r), 0);
    EXPECT_EQ(kernel.gradient_factor(r), 0);
  }
  EXPECT_GT(kernel.value(1.999 * h), 0);
  EXPECT_LT(kernel.gradient_factor(1.999 * h), 0);
}

TEST_P(Kernels, LanesAgreeWithSingleNumbers) {
  const Kernel<2> kernel(h, GetParam());
  for (int first = 0; first < 32; first += lanes) {
    Lane r;
    for (int l = 0; l < lanes; ++l) r[l] = 0.1 * (first + l) * h;
    const Lane value = kernel.value(r), factor = kernel.gradient_factor(r);
    for (int l = 0; l < lanes; ++l) {
      EXPECT_NEAR(value[l], kernel.value(double(r[l])), 1e-15 * kernel.alpha);
      EXPECT_NEAR(factor[l], kernel.gradient_factor(double(r[l])), -1e-15 * kernel.slope);
    }
  }
}

} // namespace
