// SPDX-License-Identifier: BSD-3-Clause
// The random numbers of a chain: GSL's Mersenne twister (MT19937), with a state that can be stored.
#pragma once
#include <cstdint>
#include <gsl/gsl_rng.h>
#include <memory>
#include <vector>

namespace calibration {

class RandomStream {
public:
  explicit RandomStream(std::uint64_t seed);

  double uniform();           ///< in (0, 1), 53 bits
  int below(int n);           ///< 0 to n - 1
  double normal();            ///< mean 0, deviation 1
  double chi_squared(double); ///< of the given degrees of freedom

  /// The state as GSL stores it; `restore` continues the same stream, on the same kind of machine.
  std::vector<unsigned char> state() const;
  /// Throws std::runtime_error if the size is wrong.
  void restore(const std::vector<unsigned char>& state);

private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> generator;
};

} // namespace calibration
