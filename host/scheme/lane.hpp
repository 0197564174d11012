// SPDX-License-Identifier: BSD-3-Clause
// Eight particles side by side in one vector register. Functions of the scheme are templates on the type of number:
// `Lane` for the particles of a cluster, `double` for one.
#pragma once
#include <cmath>
#include <cstring>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace host {

inline constexpr int lanes = 8;

/// Eight doubles; arithmetic and comparison act on each.
typedef double Lane __attribute__((vector_size(lanes * sizeof(double))));

inline Lane load(const double* from) {
  Lane a;
  std::memcpy(&a, from, sizeof a);
  return a;
}

inline void store(double* to, const Lane& a) {
  std::memcpy(to, &a, sizeof a);
}

/// Stores the first `count`.
inline void store(double* to, const Lane& a, int count) {
  if (count == lanes) return store(to, a);
  std::memcpy(to, &a, count * sizeof(double));
}

inline Lane square_root(const Lane& a) {
  Lane r;
  for (int k = 0; k < lanes; ++k) r[k] = std::sqrt(a[k]);
  return r;
}
inline double square_root(double a) {
  return std::sqrt(a);
}

/// The larger and the smaller of two numbers, or of each of eight pairs.
template <class Real> inline Real larger(const Real& a, const Real& b) {
  return a > b ? a : b;
}
template <class Real> inline Real smaller(const Real& a, const Real& b) {
  return a < b ? a : b;
}

/// Eight numbers in single precision, half a register, for terms that need not be exact.
typedef float SingleLane __attribute__((vector_size(lanes * sizeof(float))));

inline SingleLane single(const Lane& a) {
  return __builtin_convertvector(a, SingleLane);
}
inline float single(double a) {
  return float(a);
}
inline Lane doubled(const SingleLane& a) {
  Lane r; // GCC makes one instruction of this loop, and two of __builtin_convertvector
  for (int l = 0; l < lanes; ++l) r[l] = a[l];
  return r;
}
inline double doubled(float a) {
  return a;
}

inline SingleLane square_root(const SingleLane& a) {
  SingleLane r;
  for (int l = 0; l < lanes; ++l) r[l] = std::sqrt(a[l]);
  return r;
}
inline float square_root(float a) {
  return std::sqrt(a);
}

/// SingleLane for Lane, float for double.
template <class Real> using Single = decltype(single(Real{}));

inline double sum(const Lane& a) {
  return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
}
inline double sum(double a) {
  return a;
}

inline double largest(const Lane& a) {
  double most = a[0];
  for (int l = 1; l < lanes; ++l) most = most < a[l] ? a[l] : most;
  return most;
}

inline double largest(double a) {
  return a;
}

/// True if any of the eight is at most `limit`.
inline bool any_within(const Lane& a, double limit) {
#ifdef __AVX512F__ // GCC 12 stores the vector and loads each element
  return _mm512_cmp_pd_mask(__m512d(a), _mm512_set1_pd(limit), _CMP_LE_OQ) != 0;
#else
  bool within = false;
  for (int l = 0; l < lanes; ++l) within |= a[l] <= limit;
  return within;
#endif
}

/// True if a comparison holds for any of the eight.
inline bool any(const decltype(Lane{} < Lane{}) & mask) {
#ifdef __AVX512F__
  return _mm512_test_epi64_mask(__m512i(mask), __m512i(mask)) != 0;
#else
  auto joined = mask[0];
  for (int l = 1; l < lanes; ++l) joined |= mask[l];
  return joined != 0;
#endif
}

/// Calls f for each number.
template <class F> inline Lane each(const Lane& a, F&& f) {
  Lane r{};
  for (int l = 0; l < lanes; ++l) r[l] = f(a[l]);
  return r;
}
template <class F> inline double each(double a, F&& f) {
  return f(a);
}

} // namespace host
