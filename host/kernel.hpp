// SPDX-License-Identifier: BSD-3-Clause
// Wendland C2 kernel (Wendland 1995, Adv. Comput. Math. 4:389), support radius 2 h. The cut-off is a
// clamp, not a branch: beyond the support every value is exactly zero.
#pragma once
#include "host/lane.hpp"
#include <numbers>

namespace host {

/// Constants of W(r) = alpha (1 - r/2h)^4 (1 + 2r/h) in `Dimension` dimensions, lengths in m.
template <int Dimension> struct Kernel {
  explicit Kernel(double smoothing_length)
      : h(smoothing_length), support(2 * smoothing_length), half_inverse_h(0.5 / smoothing_length),
        alpha(Dimension == 2 ? 7 / (4 * std::numbers::pi * h * h) : 21 / (16 * std::numbers::pi * h * h * h)),
        slope(-5 * alpha / (h * h)) {}

  double h, support, half_inverse_h;
  double alpha; ///< W(0), 1/m^Dimension
  double slope; ///< W'(r)/r at r = 0

  /// W'(r)/r, so that the gradient of W at i is this times (x_i - x_j).
  template <class Real> Real gradient_factor(const Real& r) const {
    const Real o = larger(1.0 - r * half_inverse_h, Real{});
    return slope * (o * o * o);
  }

  template <class Real> Real value(const Real& r) const {
    const Real o = larger(1.0 - r * half_inverse_h, Real{});
    const Real o2 = o * o;
    return alpha * (o2 * o2) * (1.0 + 4.0 * half_inverse_h * r);
  }
};

} // namespace host
