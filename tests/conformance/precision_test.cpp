// SPDX-License-Identifier: BSD-3-Clause
// The library of single precision beside that of double.
#include "tests/conformance/library_call.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace conformance;

/// Drained triaxial compression of one point: each step finds the radial strain that keeps the radial stress.
template <class Real> class Triaxial {
public:
  Triaxial(const Grains& g, double e0, double pressure)
      : radial_(-Real(pressure)), arguments_(1, 1, own_states, properties(g, e0)) {
    for (int c = 0; c < 3; ++c) arguments_.stressOld[c] = radial_;
  }

  /// False if the update failed.
  bool step(Real axial) {
    // Secants, to what the roundings of the stress leave.
    const Real enough = 8 * std::numeric_limits<Real>::epsilon() * -radial_;
    Real ratio = ratio_, now = miss(axial, ratio), previous = ratio * Real(1.01),
         miss_previous = miss(axial, previous);
    for (int i = 0; i < 40 && std::abs(now) > enough && now != miss_previous; ++i) {
      const Real next = ratio - now * (ratio - previous) / (now - miss_previous);
      previous = ratio;
      miss_previous = now;
      ratio = next;
      now = miss(axial, ratio);
    }
    now = miss(axial, ratio);
    ratio_ = ratio;
    largest_miss = std::max(largest_miss, std::abs(double(now / radial_)));
    const bool succeeded = arguments_.stateNew[statev::status] >= 0;
    arguments_.advance();
    return succeeded;
  }

  /// q / p, compression positive.
  double stress_ratio() const {
    const auto& s = arguments_.stressOld;
    return 3 * (double(s[1]) - s[0]) / (double(s[0]) + s[1] + s[2]);
  }
  double void_ratio() const { return arguments_.stateOld[statev::void_ratio]; }

  double largest_miss = 0; ///< of the radial stress, relative

private:
  Real miss(Real axial, Real ratio) {
    arguments_.strainInc[1] = -axial;
    for (const int c : {0, 2}) arguments_.strainInc[c] = -axial * ratio;
    arguments_.call(library_);
    return arguments_.stressNew[0] - radial_;
  }

  Real radial_, ratio_ = Real(-0.3);
  vumat::Subroutine<Real>* library_ = product<Real>();
  Arguments<Real> arguments_;
};

TEST(Precision, DrainedCompressionToTwentyPercent) {
  // 2000 roundings of void ratio and stress, one of 6e-8 each: at random some 3e-6, all of one sign 1.2e-4. The
  // slope of the stress ratio over the void ratio is below 8 (n_p / e).
  constexpr int steps = 2000;
  double worst_eta = 0, worst_e = 0;
  for (const Grains& g : grains)
    for (const double e0 : {g.dense, g.loose})
      for (const double pressure : {100., 2e3, 1e4, 1e5}) {
        Triaxial<double> exact(g, e0, pressure);
        Triaxial<float> single(g, e0, pressure);
        for (int i = 0; i < steps; ++i) {
          ASSERT_TRUE(exact.step(0.2 / steps)) << pressure << " " << e0;
          ASSERT_TRUE(single.step(float(0.2 / steps))) << pressure << " " << e0;
          worst_eta = std::max(worst_eta, std::abs(single.stress_ratio() - exact.stress_ratio()));
          worst_e = std::max(worst_e, std::abs(single.void_ratio() - exact.void_ratio()));
        }
        EXPECT_GT(exact.stress_ratio(), 0.7);
        EXPECT_LT(exact.largest_miss, 1e-9);
        EXPECT_LT(single.largest_miss, 1e-5);
      }
  std::printf("stress ratio within %.1e, void ratio within %.1e\n", worst_eta, worst_e);
  EXPECT_LT(worst_eta, 1e-3);
  EXPECT_LT(worst_e, 1.2e-4);
}

TEST(Precision, RandomUpdates) {
  // The error relative to the largest stress of the update, old or new, or 1 Pa. A rounding may decide whether an
  // update is divided into substeps: then the two differ by the integrator's error of large increments, not by
  // precision. Nowhere else may they differ by more than 1e-3.
  constexpr int blocks = 400, points = 128;
  std::vector<double> errors;
  double largest_of_one_step = 0;
  int decided_otherwise = 0;
  for (int i = 0; i < blocks; ++i) {
    const Grains& g = grains[i % 3];
    const int shear = i % 2 ? 1 : 3;
    Arguments<double> a(points, shear, own_states, properties(g, g.dense));
    Arguments<float> b(points, shear, own_states, properties(g, g.dense));
    set_random(a, i);
    set_random(b, i);
    a.call(product<double>());
    b.call(product<float>());
    for (int k = 0; k < points; ++k) {
      const int j_status = statev::status * points + k;
      const double status = a.stateNew[j_status], status_single = b.stateNew[j_status];
      ASSERT_GE(status, 0);
      ASSERT_GE(status_single, 0);
      decided_otherwise += status != status_single;
      double error = 0, size = 1;
      for (int c = 0; c < 3 + shear; ++c) {
        const int j = c * points + k;
        error = std::max(error, std::abs(b.stressNew[j] - a.stressNew[j]));
        size = std::max({size, std::abs(a.stressOld[j]), std::abs(a.stressNew[j])});
      }
      errors.push_back(error / size);
      const double largest_status = std::max(status, status_single);
      if (largest_status < 3) largest_of_one_step = std::max(largest_of_one_step, error / size);
      // A rounding of the void ratio for each substep of lanes, of which 1024 are more than were seen.
      const double substeps = largest_status < 2 ? 1 : 1024;
      ASSERT_NEAR(b.stateNew[k], a.stateNew[k], 2e-7 + 6e-8 * substeps);
    }
  }
  std::sort(errors.begin(), errors.end());
  const auto share = [&](double s) { return errors[std::size_t(s * double(errors.size() - 1))]; };
  std::printf("relative error of the stress: median %.1e, 99 %% %.1e, 99.9 %% %.1e, largest %.1e, without "
              "substeps %.1e; another status %d of %zu\n",
              share(0.5), share(0.99), share(0.999), errors.back(), largest_of_one_step, decided_otherwise,
              errors.size());
  EXPECT_LT(share(0.5), 1e-6);
  EXPECT_LT(share(0.99), 2e-5);
  EXPECT_LT(share(0.999), 1e-4);
  EXPECT_LT(largest_of_one_step, 1e-3);
}

} // namespace
