// SPDX-License-Identifier: BSD-3-Clause
// Numbers side by side in one vector register. The functions of the model are templates on the number: a
// scalar, or `Lanes` of it. What differs between the two is here: comparison gives a mask, `select` chooses by it,
// and exp, log, sqrt, min, max and abs are found for either. Compilers without wide vectors split them.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

// Bytes of one register of lanes, by default the widest of the target; 0: no lanes, every point alone.
#ifndef SIMSAND_VECTOR_BYTES
#if defined(__AVX512F__)
#define SIMSAND_VECTOR_BYTES 64
#elif defined(__AVX__)
#define SIMSAND_VECTOR_BYTES 32
#else
#define SIMSAND_VECTOR_BYTES 16
#endif
#endif

namespace simsand {

using std::abs;
using std::exp;
using std::log;
using std::max;
using std::min;
using std::sqrt;

/// Whether points are updated side by side, and how many.
inline constexpr bool use_lanes = SIMSAND_VECTOR_BYTES > 0;
template <class T> inline constexpr int lane_count = (use_lanes ? SIMSAND_VECTOR_BYTES : 16) / int(sizeof(T));

/// Integers as wide as T.
template <class T> using BitsOf = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;

/// The compiler's vector of T in one register, and how many of them hold W.
template <class T, int W> struct Registers {
  static constexpr int bytes = use_lanes ? SIMSAND_VECTOR_BYTES : 16;
  static constexpr int each = bytes / int(sizeof(T)), count = W / each;
  typedef T Vector __attribute__((vector_size(bytes)));
  typedef BitsOf<T> Integers __attribute__((vector_size(bytes)));
};

/// Calls f(0), f(1), ..., f(count - 1), written out: registers then stay registers.
template <int count, class F> void for_each_register(const F& f) {
  if constexpr (count > 1) for_each_register<count - 1>(f);
  f(count - 1);
}

/// W truths, what a comparison of lanes gives.
template <class T, int W> struct LaneMask {
  using R = Registers<T, W>;
  typename R::Integers v[R::count]; // all bits set: true

  bool operator[](int k) const { return v[k / R::each][k % R::each] != 0; }
  void set(int k, bool value) { v[k / R::each][k % R::each] = -BitsOf<T>(value); }
  LaneMask& operator&=(const LaneMask& b) { return *this = *this & b; }
  LaneMask& operator|=(const LaneMask& b) { return *this = *this | b; }
  friend LaneMask operator!(const LaneMask& a) {
    return map([&](int i) { return ~a.v[i]; });
  }
  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    return map([&](int i) { return a.v[i] & b.v[i]; });
  }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) {
    return map([&](int i) { return a.v[i] | b.v[i]; });
  }
  friend bool all(const LaneMask& a) {
    auto every = a.v[0];
    for (int i = 1; i < R::count; ++i) every &= a.v[i];
    auto result = every[0];
    for (int k = 1; k < R::each; ++k) result &= every[k];
    return result != 0;
  }
  template <class F> static LaneMask map(const F& f) {
    LaneMask r;
    for_each_register<R::count>([&](int i) { r.v[i] = f(i); });
    return r;
  }
};

/// W numbers T; arithmetic and comparison act on each. A scalar beside them stands for W equal ones.
template <class T, int W> struct Lanes {
  using R = Registers<T, W>;
  using Vector = typename R::Vector;
  using Integers = typename R::Integers;
  using Truths = LaneMask<T, W>;

  Vector v[R::count];

  Lanes() = default;
  Lanes(T scalar) {
    for_each_register<R::count>([&](int i) { v[i] = scalar - Vector{}; });
  }

  T operator[](int k) const { return v[k / R::each][k % R::each]; }
  void set(int k, T value) { v[k / R::each][k % R::each] = value; }

  static Lanes read(const T* from) {
    return map([&](int i) {
      Vector r;
      std::memcpy(&r, from + i * R::each, sizeof r);
      return r;
    });
  }
  void write(T* to) const {
    for_each_register<R::count>([&](int i) { std::memcpy(to + i * R::each, &v[i], sizeof v[i]); });
  }

  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  friend Lanes operator-(const Lanes& a) {
    return map([&](int i) { return -a.v[i]; });
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return map([&](int i) { return a.v[i] + b.v[i]; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return map([&](int i) { return a.v[i] - b.v[i]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return map([&](int i) { return a.v[i] * b.v[i]; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return map([&](int i) { return a.v[i] / b.v[i]; });
  }
  friend Truths operator<(const Lanes& a, const Lanes& b) {
    return Truths::map([&](int i) { return a.v[i] < b.v[i]; });
  }
  friend Truths operator>(const Lanes& a, const Lanes& b) {
    return Truths::map([&](int i) { return a.v[i] > b.v[i]; });
  }
  friend Truths operator<=(const Lanes& a, const Lanes& b) {
    return Truths::map([&](int i) { return a.v[i] <= b.v[i]; });
  }
  friend Truths operator>=(const Lanes& a, const Lanes& b) {
    return Truths::map([&](int i) { return a.v[i] >= b.v[i]; });
  }

  friend Lanes select(const Truths& mask, const Lanes& a, const Lanes& b) {
    return map([&](int i) { return mask.v[i] ? a.v[i] : b.v[i]; });
  }
  friend Lanes min(const Lanes& a, const Lanes& b) {
    return map([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
  }
  friend Lanes max(const Lanes& a, const Lanes& b) {
    return map([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
  }
  friend Lanes abs(const Lanes& a) { return max(a, -a); }
  friend Lanes sqrt(const Lanes& a) {
    return map([&](int i) {
      Vector r;
      for (int k = 0; k < R::each; ++k) r[k] = std::sqrt(a.v[i][k]);
      return r;
    });
  }

  template <class F> static Lanes map(const F& f) {
    Lanes r;
    for_each_register<R::count>([&](int i) { r.v[i] = f(i); });
    return r;
  }
};

template <class T> struct ScalarOf { using type = T; };
template <class T, int W> struct ScalarOf<Lanes<T, W>> { using type = T; };
/// The number that a lane holds, or the scalar itself.
template <class Real> using Scalar = typename ScalarOf<Real>::type;

/// Smallest positive number of full precision: a guard of divisors.
template <class T> inline constexpr T tiny = std::numeric_limits<T>::min();

/// What a comparison of two Reals gives.
template <class Real> using Mask = decltype(Real() < Real());

inline bool select(bool mask, bool a, bool b) {
  return mask ? a : b;
}
inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}
inline float select(bool mask, float a, float b) {
  return mask ? a : b;
}
inline bool all(bool mask) {
  return mask;
}
} // namespace simsand
