// SPDX-License-Identifier: BSD-3-Clause
// Eight particles side by side in one vector register. Pair functions are templates on the lane type:
// `Lane` in the stages, `double` in tests.
#pragma once
#include <cmath>
#include <cstring>

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

inline Lane larger(const Lane& a, const Lane& b) {
  return a > b ? a : b;
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}

inline Lane smaller(const Lane& a, const Lane& b) {
  return a < b ? a : b;
}
inline double smaller(double a, double b) {
  return a < b ? a : b;
}

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

/// True if a comparison holds for any of the eight.
inline bool any(const decltype(Lane{} < Lane{}) & mask) {
  auto joined = mask[0];
  for (int l = 1; l < lanes; ++l) joined |= mask[l];
  return joined != 0;
}

/// f(x) of each.
template <class F> inline Lane each(const Lane& a, F&& f) {
  Lane r{};
  for (int l = 0; l < lanes; ++l) r[l] = f(a[l]);
  return r;
}
template <class F> inline double each(double a, F&& f) {
  return f(a);
}

} // namespace host
