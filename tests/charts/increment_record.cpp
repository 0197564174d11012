// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/increment_record.hpp"
#include <cstring>

namespace charts {

double pressure_of(const SampledUpdate& u) {
  return (u[4] + u[5] + u[6]) / 3;
}

double strain_of(const SampledUpdate& u) {
  return std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] + 2 * u[3] * u[3]);
}

std::uint64_t hash_of(std::uint64_t seed, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  bits += seed + 0x9e3779b97f4a7c15; // the finaliser of splitmix64
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

void IncrementRecord::note(int phase, const SampledUpdate& update, int status, std::uint64_t hash,
                           double yield_by_pressure) {
  const double p = pressure_of(update);
  const auto step = [](double value, double least, double per_decade) {
    return value > least ? 1 + int(std::floor(std::log10(value / least) * per_decade)) : 0;
  };
  const IncrementClass at{phase, step(strain_of(update), least_strain, strain_classes_per_decade),
                          step(p, least_pressure, pressure_classes_per_decade)};
  if (status >= 0 && status < 4) ++counts[at][status];
  if (p > 0) {
    ++under_stress;
    outside[0] += yield_by_pressure > 1e-6;
    outside[1] += yield_by_pressure > 1e-2;
  }
  if (phase == 0) keep(hash, update);
}

void IncrementRecord::keep(std::uint64_t hash, const SampledUpdate& update) {
  if (kept.size() >= most_kept && (most_kept == 0 || hash >= kept.rbegin()->first)) return;
  kept.emplace(hash, update);
  if (kept.size() > most_kept) kept.erase(std::prev(kept.end()));
}

void IncrementRecord::add(const IncrementRecord& other) {
  for (const auto& [at, count] : other.counts)
    for (int i = 0; i < 4; ++i) counts[at][i] += count[i];
  for (int i = 0; i < 2; ++i) outside[i] += other.outside[i];
  under_stress += other.under_stress;
  for (const auto& [hash, update] : other.kept) keep(hash, update);
}

} // namespace charts
