// SPDX-License-Identifier: BSD-3-Clause
// Wendland's kernels C2 and C4 (Wendland 1995, Adv. Comput. Math. 4:389; Dehnen and Aly 2012, MNRAS 425:1068, Table 1),
// support radius 2 h. The cut-off is a clamp, not a branch: beyond the support every value is exactly zero.
#pragma once
#include "host/scheme/lane.hpp"
#include <numbers>

namespace host {

/// Continuous derivatives: two or four.
enum class KernelKind { wendland_c2, wendland_c4 };

/// Constants of a kernel in `Dimension` dimensions, lengths in m. With q = r/2h:
/// C2: W = alpha (1 - q)^4 (1 + 4q); C4: W = alpha (1 - q)^6 (1 + 6q + 35/3 q^2).
template <int Dimension> struct Kernel {
  explicit Kernel(double smoothing_length, KernelKind kernel_kind = KernelKind::wendland_c2)
      : kind(kernel_kind), h(smoothing_length), support(2 * smoothing_length),
        half_inverse_h(0.5 / smoothing_length), alpha(normalisation() / volume()),
        slope((kind == KernelKind::wendland_c2 ? -20 : -56.0 / 3) * alpha / (support * support)) {}

  KernelKind kind;
  double h, support, half_inverse_h;
  double alpha; ///< W(0), 1/m^Dimension
  double slope; ///< W'(r)/r at r = 0

  /// W'(r)/r: the gradient of W at i is this times (x_i - x_j).
  template <class Real> Real gradient_factor(const Real& r) const {
    const Real q = r * half_inverse_h, o = larger(1.0 - q, Real{}), o3 = o * o * o;
    if (kind == KernelKind::wendland_c2) return slope * o3;
    return slope * (o3 * (o * o)) * (1.0 + 5.0 * q);
  }

  /// W'(r)/r over `pair_scale`, from the square of r, m2, in single precision, which takes half the time. It is the same
  /// from both sides of a pair, and the velocity gradient stays exact, since it is corrected by sums of the same weights.
  /// Exactly zero where r exceeds the support by more than 1e-7 of it.
  template <class Real> Single<Real> pair_shape(const Real& square) const {
    const Single<Real> reach = Single<Real>{} + float(support),
                       r = smaller(square_root(single(square)), reach);
    const Single<Real> d = reach - r, d2 = d * d;
    if (kind == KernelKind::wendland_c2) return d2 * d;
    return d2 * d2 * d * (1 + float(5 * half_inverse_h) * r);
  }
  /// Factor of sums of `pair_shape`, when all neighbours have been added.
  double pair_scale() const {
    const double power = half_inverse_h * half_inverse_h * half_inverse_h;
    return slope * (kind == KernelKind::wendland_c2 ? power : power * half_inverse_h * half_inverse_h);
  }

  /// W(r), 1/m^Dimension.
  template <class Real> Real value(const Real& r) const {
    const Real q = r * half_inverse_h, o = larger(1.0 - q, Real{});
    const Real o2 = o * o, o4 = o2 * o2;
    if (kind == KernelKind::wendland_c2) return alpha * o4 * (1.0 + 4.0 * q);
    return alpha * (o4 * o2) * (1.0 + q * (6.0 + (35.0 / 3) * q));
  }

private:
  double volume() const { return Dimension == 2 ? support * support : support * support * support; }
  double normalisation() const {
    const bool smooth = kind == KernelKind::wendland_c4;
    constexpr double pi = std::numbers::pi;
    return Dimension == 2 ? (smooth ? 9 : 7) / pi : (smooth ? 495.0 / 32 : 21.0 / 2) / pi;
  }
};

} // namespace host
