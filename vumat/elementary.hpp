// SPDX-License-Identifier: BSD-3-Clause
// exp and log of lanes. Their sums must be rounded in the order they are written in, so -ffast-math is not allowed.
#pragma once
#include "vumat/lanes.hpp"

namespace simsand {

/// Bit patterns and lengths of series of the two precisions.
template <class T> struct Format;
template <> struct Format<double> {
  static constexpr int fraction_bits = 52, exp_terms = 13, log_terms = 11;
  static constexpr std::int64_t one = 0x3ff0000000000000, root_half = 0x3fe6a09e667f3bcd;
  static constexpr double round = 6755399441055744.0; // 1.5 2^52: a sum with it is rounded to an integer
  static constexpr double ln2_high = 0.693147180369123816490, ln2_low = 1.90821492927058770002e-10;
  static constexpr double largest_exponent = 708;
};
template <> struct Format<float> {
  static constexpr int fraction_bits = 23, exp_terms = 7, log_terms = 5;
  static constexpr std::int32_t one = 0x3f800000, root_half = 0x3f3504f3;
  static constexpr float round = 12582912.0f; // 1.5 2^23
  static constexpr float ln2_high = 0.693359375f, ln2_low = -2.12194440e-4f;
  static constexpr float largest_exponent = 87;
};

template <class To, class From> To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

/// Coefficients of exp r = sum r^k / k! and (atanh s - s) / s^3 = sum s^2k / (2k + 3).
template <class T> struct Series {
  T of_exp[Format<T>::exp_terms], of_log[Format<T>::log_terms];
  constexpr Series() : of_exp(), of_log() {
    double factorial = 1;
    for (int k = 0; k < Format<T>::exp_terms; factorial *= ++k) of_exp[k] = T(1 / factorial);
    for (int k = 0; k < Format<T>::log_terms; ++k) of_log[k] = T(1.0 / (2 * k + 3));
  }
};
template <class T> inline constexpr Series<T> series{};

/// sum c[k] x^k: even and odd powers apart, two short chains in place of one long.
template <int terms, class T> Lanes<T> polynomial(const T (&c)[terms], const Lanes<T>& x) {
  const Lanes<T> square = x * x;
  Lanes<T> even = c[(terms - 1) / 2 * 2], odd = c[terms / 2 * 2 - 1];
  for (int k = (terms - 1) / 2 * 2 - 2; k >= 0; k -= 2) even = even * square + c[k];
  for (int k = terms / 2 * 2 - 3; k >= 1; k -= 2) odd = odd * square + c[k];
  return even + odd * x;
}

/// exp, x held within +-708 (float: +-87): x = k ln 2 + r, |r| <= ln 2 / 2. Relative error below 5e-16 (float: 4e-7).
template <class T> Lanes<T> exp(const Lanes<T>& exponent) {
  using F = Format<T>;
  using L = Lanes<T>;
  const L x = within(exponent, -F::largest_exponent, F::largest_exponent);
  const L shifted = x * T(1.4426950408889634) + F::round, k = shifted - F::round;
  const L r = (x - k * F::ln2_high) - k * F::ln2_low;
  const auto bits = bit_cast<typename Register<T>::Integers>(shifted.v);
  const L power = L::of(bit_cast<typename L::Vector>((bits << F::fraction_bits) + F::one));
  return polynomial(series<T>.of_exp, r) * power;
}

/// ln of a positive normal number: x = 2^k m, m within sqrt 2 of 1, ln m = 2 atanh((m - 1) / (m + 1)).
/// Relative error below 5e-16 (float: 4e-7).
template <class T> Lanes<T> log(const Lanes<T>& x) {
  using F = Format<T>;
  using L = Lanes<T>;
  using Vector = typename L::Vector;
  using Integers = typename Register<T>::Integers;
  const Integers bits = bit_cast<Integers>(x.v), exponent = (bits - F::root_half) >> F::fraction_bits;
  const Integers round_bits = bit_cast<Integers>(F::round - Vector{});
  const L k = L::of(bit_cast<Vector>(exponent + round_bits) - F::round);
  const L f = L::of(bit_cast<Vector>(bits - (exponent << F::fraction_bits)) - T(1));
  const L s = f / (f + T(2)), z = s * s, half_square = f * f * T(0.5);
  const L tail = T(2) * z * polynomial(series<T>.of_log, z);
  // 2 atanh s = f - f^2/2 + s (f^2/2 + tail): f is exact, so small logarithms keep their digits.
  return k * F::ln2_high - ((half_square - (s * (half_square + tail) + k * F::ln2_low)) - f);
}

} // namespace simsand
