// SPDX-License-Identifier: BSD-3-Clause
// A record of the calls to a material in plane strain or axisymmetry.
#pragma once
#include "tests/charts/sand.hpp"
#include <array>
#include <cstdint>
#include <map>
#include <tuple>

namespace charts {

/// What an update was given, in the order of `states_header`, compression positive.
using SampledUpdate = std::array<double, 11>;

/// Classes of updates: quarters of a decade of strain, halves of a decade of mean stress.
struct IncrementClass {
  int phase, strain, pressure;
  auto operator<=>(const IncrementClass&) const = default;
};
inline constexpr double strain_classes_per_decade = 4, pressure_classes_per_decade = 2;
/// Below these all is one class.
inline constexpr double least_strain = 1e-12, least_pressure = 1e-3;

struct IncrementRecord {
  std::map<IncrementClass, std::array<std::int64_t, 4>> counts; ///< elastic, plastic, stress free, substepped
  std::array<std::int64_t, 2>
      outside{}; ///< given under stress: outside of the yield surface by 1e-6 p; by 1e-2 p
  std::int64_t under_stress = 0;
  std::map<std::uint64_t, SampledUpdate> kept; ///< those of least hash
  std::size_t most_kept = 0;

  void note(int phase, const SampledUpdate& update, int status, std::uint64_t hash, double yield_by_pressure);
  void add(const IncrementRecord& other);

private:
  void keep(std::uint64_t hash, const SampledUpdate& update);
};

/// Mean stress and size of the strain of an update.
double pressure_of(const SampledUpdate& update);
double strain_of(const SampledUpdate& update);

/// A number that looks random, the same for the same bits.
std::uint64_t hash_of(std::uint64_t seed, double value);

} // namespace charts
