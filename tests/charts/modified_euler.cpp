// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/integrators.hpp"

namespace charts {
namespace {

/// Shortest substep as a share of the plastic part, and most substeps: beyond, the increment failed.
constexpr double shortest = 1e-8;
constexpr int most_substeps = 20000;
/// Errors are relative to no less than this share of p_min, and a point that loses pressure has parted below it.
constexpr double least_stress = 1e-3;

struct Heun {
  Point end;
  double error;
  bool valid;
};

/// One substep by the mean of the rates at its start and its first guess of the end.
Heun heun(const Material& m, const Point& from, const Tensor& strain) {
  const Rate first = plastic_rate(local(m, from, strain), strain);
  const Point guess = moved(from, 1, first);
  if (!(mean(guess.stress) > 0)) return {from, 0, false};
  const Rate second = plastic_rate(local(m, guess, strain), strain);
  const Point end = moved(moved(from, 0.5, first), 0.5, second);
  if (!(mean(end.stress) > 0)) return {from, 0, false};
  const double stress_error = 0.5 * norm(simsand::add(second.stress, -1., first.stress)) /
                              std::max(norm(end.stress), least_stress * m.given.p_min);
  const double hardening_error =
      0.5 * std::abs(second.eps_d - first.eps_d) / (m.given.k_p + end.plastic_strain);
  return {end, std::max(stress_error, hardening_error), true};
}

/// Whether a point of hardly any stress is about to lose it.
bool empties(const Material& m, const Point& point, const Tensor& strain) {
  return mean(point.stress) < least_stress * m.given.p_min &&
         simsand::trace(plastic_rate(local(m, point, strain), strain).stress) < 0;
}

Answer substep(const Material& m, const Point& old, const Tensor& strain, double tolerance) {
  const double volumetric = simsand::trace(strain), share = elastic_share(m, old, strain);
  Point point = elastic_answer(m, old, simsand::scale(share, strain)).point;
  if (share >= 1)
    return {elastic_answer(m, old, strain).measure > 0 ? point : parted(m, old, volumetric, 0, 0)};
  if (!(mean(point.stress) > 0)) { // no rates at zero pressure: the elastic answer, returned
    point = elastic_answer(m, old, strain).point;
    const bool returned = correct_drift(m, point, strain);
    return {point, returned};
  }
  const auto rest = simsand::scale(1 - share, strain);
  double done = 0, size = 1;
  bool failed_before = false;
  for (int i = 0; i < most_substeps && done < 1; ++i) {
    if (empties(m, point, rest))
      return {parted(m, old, volumetric, volumetric * (share + (1 - share) * done), 0)};
    const auto step = heun(m, point, simsand::scale(size, rest));
    if (!step.valid || step.error > tolerance) {
      if (size <= shortest) return {old, false};
      const double cut = step.valid ? 0.9 * std::sqrt(tolerance / step.error) : 0.25;
      size = std::max(size * std::max(cut, 0.1), shortest);
      failed_before = true;
      continue;
    }
    Point corrected = step.end;
    if (!correct_drift(m, corrected, strain)) {
      if (size <= shortest) return {old, false};
      size = std::max(size / 4, shortest);
      continue;
    }
    point = corrected;
    done += size;
    const double growth =
        std::min(0.9 * std::sqrt(tolerance / std::max(step.error, 1e-300)), failed_before ? 1. : 1.1);
    size = std::min(size * std::max(growth, 0.1), 1 - done);
    if (1 - done < 1e-14) done = 1;
    failed_before = false;
  }
  point.void_ratio = simsand::void_ratio_after(old.void_ratio, volumetric);
  return {point, done >= 1};
}

} // namespace

Answer modified_euler(const Material& m, const Point& old, const Tensor& strain, double tolerance) {
  return after_gap(old, strain, [&](const Point& p, const Tensor& e) { return substep(m, p, e, tolerance); });
}

} // namespace charts
