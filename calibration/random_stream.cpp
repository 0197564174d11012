// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/random_stream.hpp"
#include <algorithm>
#include <gsl/gsl_randist.h>
#include <stdexcept>

namespace calibration {
namespace {

constexpr double two_to_26 = 67108864, two_to_53 = 9007199254740992;

} // namespace

RandomStream::RandomStream(std::uint64_t seed) : generator(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free) {
  // GSL uses the lower 32 bits of a seed and replaces 0 by its default: the hash mixes the upper half in.
  const std::uint64_t mixed = (seed + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
  gsl_rng_set(generator.get(), (mixed >> 32 ^ mixed) & 0xffffffffu);
}

double RandomStream::uniform() {
  const double high = gsl_rng_get(generator.get()) >> 5, low = gsl_rng_get(generator.get()) >> 6;
  return (high * two_to_26 + low + 0.5) / two_to_53;
}

int RandomStream::below(int n) {
  return int(gsl_rng_uniform_int(generator.get(), n));
}

double RandomStream::normal() {
  return gsl_ran_gaussian_ziggurat(generator.get(), 1);
}

double RandomStream::chi_squared(double freedom) {
  return gsl_ran_chisq(generator.get(), freedom);
}

std::vector<unsigned char> RandomStream::state() const {
  const auto* bytes = static_cast<const unsigned char*>(gsl_rng_state(generator.get()));
  return {bytes, bytes + gsl_rng_size(generator.get())};
}

void RandomStream::restore(const std::vector<unsigned char>& state) {
  if (state.size() != gsl_rng_size(generator.get()))
    throw std::runtime_error("the stored state does not fit the random number generator of this program");
  std::copy(state.begin(), state.end(), static_cast<unsigned char*>(gsl_rng_state(generator.get())));
}

} // namespace calibration
