// SPDX-License-Identifier: BSD-3-Clause
// What one core of this machine can do at most, measured: the ceilings that the stages of a step are held against.
#pragma once
#include "host/scheme/lane.hpp"
#include <algorithm>
#include <chrono>
#include <vector>

namespace tests {

struct Peaks {
  double flops = 0; ///< multiply-adds in double, two flops each, 1/s
  double bytes = 0; ///< a(i) = b(i) + s c(i) from memory, 24 bytes each, 1/s
};

/// Seconds of the fastest of `repeats` runs of f.
template <class F> double least_seconds(int repeats, F&& f) {
  double least = 1e9;
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::chrono::steady_clock::now();
    f();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

inline double peak_flops() {
  constexpr int chains = 12; // independent, so that latency is hidden
  constexpr long rounds = 2000000;
  host::Lane a[chains], factor{}, term{};
  for (auto& x : a) x = host::Lane{} + 1.0;
  factor += 0.999999;
  term += 1e-6;
  const double seconds = least_seconds(7, [&] {
    for (long k = 0; k < rounds; ++k)
      for (auto& x : a) x = x * factor + term;
    for (auto& x : a) asm volatile("" : "+v"(x)); // the numbers are used
  });
  return 2.0 * host::lanes * chains * rounds / seconds;
}

inline double peak_bytes() {
  constexpr std::size_t count = std::size_t(1) << 24; // 128 MiB each, beyond every cache
  std::vector<double> a(count, 0), b(count, 1), c(count, 2);
  const double seconds = least_seconds(5, [&] {
    for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 3 * c[i];
    asm volatile("" : : "r"(a.data()) : "memory");
  });
  return 24.0 * count / seconds;
}

inline Peaks measured_peaks() {
  return {peak_flops(), peak_bytes()};
}

} // namespace tests
