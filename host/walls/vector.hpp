// SPDX-License-Identifier: BSD-3-Clause
// Vectors of two or three components, for what is done particle by particle.
#pragma once
#include <array>
#include <cstddef>

namespace host {

template <int D> struct Vector : std::array<double, std::size_t(D)> {};

template <int D> double dot(const Vector<D>& a, const Vector<D>& b) {
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += a[c] * b[c];
  return sum;
}

/// a += factor b
template <int D> void add_scaled(Vector<D>& a, double factor, const Vector<D>& b) {
  for (int c = 0; c < D; ++c) a[c] += factor * b[c];
}

/// From any array of components.
template <int D, class P> Vector<D> vector_of(const P& components) {
  Vector<D> v;
  for (int a = 0; a < D; ++a) v[a] = components[a];
  return v;
}

} // namespace host
