// SPDX-License-Identifier: BSD-3-Clause
// Numbers side by side in one vector register. The functions of the model are templates on the number: one number of
// float or double, or `Lanes` of them. What differs between the two is here: a comparison gives a mask, and `select`
// chooses by it. Without vector registers a lane is one number, and the same functions update one point after another.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

// Bytes of one register, by default the widest of the target; 0: no vector registers.
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

inline constexpr bool use_registers = SIMSAND_VECTOR_BYTES > 0;
/// Numbers in one register.
template <class T>
inline constexpr int lane_count = use_registers ? SIMSAND_VECTOR_BYTES / int(sizeof(T)) : 1;

/// Integers as wide as T.
template <class T> using BitsOf = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;

/// The compiler's vectors of one register.
template <class T> struct Register {
  static constexpr int bytes = use_registers ? SIMSAND_VECTOR_BYTES : 16;
  typedef T Vector __attribute__((vector_size(bytes)));
  typedef BitsOf<T> Integers __attribute__((vector_size(bytes)));
};

/// Truths, what a comparison of lanes gives.
template <class T> struct LaneMask {
  typename Register<T>::Integers v; // all bits set: true

  bool operator[](int k) const { return v[k] != 0; }
  LaneMask& operator|=(const LaneMask& b) { return *this = *this | b; }
  friend LaneMask operator!(const LaneMask& a) { return {~a.v}; }
  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return {a.v & b.v}; }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return {a.v | b.v}; }
  friend bool all(const LaneMask& a) {
    auto result = a.v[0];
    for (int k = 1; k < lane_count<T>; ++k) result &= a.v[k];
    return result != 0;
  }
};

/// The numbers T of one register; arithmetic and comparison act on each. One number beside them stands for equal ones.
template <class T> struct Lanes {
  using Vector = typename Register<T>::Vector;
  using Truths = LaneMask<T>;

  Vector v;

  Lanes() = default;
  Lanes(T number) : v(number - Vector{}) {}
  static Lanes of(const Vector& vector) {
    Lanes r;
    r.v = vector;
    return r;
  }

  T operator[](int k) const { return v[k]; }
  void set(int k, T value) { v[k] = value; }

  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  friend Lanes operator-(const Lanes& a) { return of(-a.v); }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return of(a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return of(a.v - b.v); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return of(a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return of(a.v / b.v); }
  friend Truths operator<(const Lanes& a, const Lanes& b) { return {a.v < b.v}; }
  friend Truths operator>(const Lanes& a, const Lanes& b) { return {a.v > b.v}; }
  friend Truths operator<=(const Lanes& a, const Lanes& b) { return {a.v <= b.v}; }
  friend Truths operator>=(const Lanes& a, const Lanes& b) { return {a.v >= b.v}; }

  friend Lanes select(const Truths& mask, const Lanes& a, const Lanes& b) { return of(mask.v ? a.v : b.v); }
  friend Lanes min(const Lanes& a, const Lanes& b) { return of(a.v < b.v ? a.v : b.v); }
  friend Lanes max(const Lanes& a, const Lanes& b) { return of(a.v > b.v ? a.v : b.v); }
  friend Lanes abs(const Lanes& a) { return max(a, -a); }
  friend Lanes sqrt(const Lanes& a) {
    Lanes r;
    for (int k = 0; k < lane_count<T>; ++k) r.v[k] = std::sqrt(a.v[k]);
    return r;
  }
};

/// What registers hold: lanes, or one number where there are no vector registers.
template <class T> using Lane = std::conditional_t<use_registers, Lanes<T>, T>;

template <class T> struct ScalarOf { using type = T; };
template <class T> struct ScalarOf<Lanes<T>> { using type = T; };
/// The type of one number.
template <class Real> using Scalar = typename ScalarOf<Real>::type;
template <class Real> inline constexpr bool is_one_number = std::is_floating_point_v<Real>;
/// Numbers in a Real.
template <class Real> inline constexpr int lanes_of = is_one_number<Real> ? 1 : lane_count<Scalar<Real>>;

/// What a comparison of two Reals gives.
template <class Real> using Mask = decltype(Real() < Real());

// The same for one number.
inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}
inline float select(bool mask, float a, float b) {
  return mask ? a : b;
}
inline bool all(bool mask) {
  return mask;
}

template <class Real> Scalar<Real> lane(const Real& a, int k) {
  if constexpr (is_one_number<Real>)
    return a;
  else
    return a[k];
}
template <class Real> void set_lane(Real& a, int k, Scalar<Real> value) {
  if constexpr (is_one_number<Real>)
    a = value;
  else
    a.set(k, value);
}
/// Numbers that stand one after another in memory.
template <class Real> Real read(const Scalar<Real>* from) {
  Real a;
  std::memcpy(&a, from, sizeof a);
  return a;
}
template <class Real> void write(const Real& a, Scalar<Real>* to) {
  std::memcpy(to, &a, sizeof a);
}

// Bounds of any kind of number. They are written as double and rounded to the number's own precision.
template <class Real> Real at_least(const Real& a, double bound) {
  return max(a, Real(Scalar<Real>(bound)));
}
template <class Real> Real at_most(const Real& a, double bound) {
  return min(a, Real(Scalar<Real>(bound)));
}
template <class Real> Real within(const Real& a, double lower, double upper) {
  return at_most(at_least(a, lower), upper);
}

/// Smallest positive number of full precision. Divisors are kept above it.
template <class T> inline constexpr T tiny = std::numeric_limits<T>::min();
template <class Real> Real positive(const Real& divisor) {
  return max(divisor, Real(tiny<Scalar<Real>>));
}
} // namespace simsand
