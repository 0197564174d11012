// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/leg_run.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

std::string failure_reason(const StageSetting& setting, const Stage& stage, const StepReport& report) {
  if (report.refused || !report.finite) return setting.material.evidence(setting.failed_point);
  return fmt::format("condition {} of 6 misses by {:.3g} {}", report.condition + 1, report.residual,
                     stage.conditions[report.condition].unit());
}

std::string failure_text(const StageSetting& setting, const Stage& stage, const StepReport& report) {
  return fmt::format("{}; {} cuts and {} iterations", failure_reason(setting, stage, report), report.cuts,
                     report.iterations);
}

} // namespace

LegRun::LegRun(const StageSetting& setting, const Stage& stage, ElementRow& row)
    : stage(stage), row(row), start(row), control(control_from(stage, row.point.stress, row.point.strain)),
      setting(setting), stiffness(setting.material.elastic_stiffness(row.point)),
      scale(scale_of(row.point.stress, stiffness)), stops(bounds_of(stage.stops, setting.columns)) {}

StepReport LegRun::advance_row(const Leg& leg, double from, double to, ElementRow& at,
                               Matrix6& tangent) const {
  const auto report = stage.motion ? follow(setting.material, *stage.motion, start.point.gradient, from, to,
                                            leg.duration, at.point)
                                   : advance(setting.material, leg.control, from, to, leg.duration, scale,
                                             setting.newton, at.point, tangent);
  at.effort.iterations += report.iterations;
  at.effort.cuts += report.cuts;
  const double change = pore_pressure_change(stage, at.point.stress - start.point.stress);
  at.pore_pressure = stage.pore_pressure.value_or(start.pore_pressure) + change;
  at.pore_pressure_ratio = pore_pressure_ratio(stage, start.point.stress, change);
  if (stage.cycling)
    at.double_amplitude = std::abs(stage.cycling->strain->weights.dot(at.point.strain) - reversal_strain);
  return report;
}

bool LegRun::passed(const std::vector<Bound>& bounds) const {
  return std::any_of(bounds.begin(), bounds.end(), [&](const auto& b) { return b.excess(row) > 0; });
}

void LegRun::end_on(const Bound& bound, const Leg& leg, const IncrementStart& increment, double& to) {
  double low = increment.from, high = to;
  double low_weight = bound.excess(increment.before), high_weight = bound.excess(row);
  if (low_weight > 0) return; // passed before this increment
  const double enough = 1e-10 * std::max(std::abs(bound.bound), high_weight - low_weight);
  const double narrow = 1e-13 * (to - increment.from);
  // False position; an end that is kept twice in a row counts half (Illinois). Every fourth step is a bisection, which
  // bounds the number of steps.
  int side = 0;
  for (int i = 0; i < 80 && bound.excess(row) > enough && high - low > narrow; ++i) {
    const double share = i % 4 == 3 ? 0.5 : high_weight / (high_weight - low_weight);
    const double at = high - std::clamp(share, 1e-9, 1 - 1e-9) * (high - low);
    auto trial = increment.before;
    auto tangent = increment.tangent;
    const auto report = advance_row(leg, increment.from, at, trial, tangent);
    if (!report.converged) break; // keeps the last increment that converged
    const double excess = bound.excess(trial);
    if (excess > 0) {
      trial.step = row.step;
      trial.effort.iterations += row.effort.iterations - increment.before.effort.iterations;
      row = std::move(trial);
      stiffness = tangent;
      high = at, high_weight = excess;
      if (side == 1) low_weight /= 2;
      side = 1;
    } else {
      row.effort.iterations += report.iterations;
      low = at, low_weight = excess;
      if (side == -1) high_weight /= 2;
      side = -1;
    }
  }
  to = high;
}

bool LegRun::critical_since(const ElementRow& before) const {
  return std::any_of(stage.stops.begin(), stage.stops.end(), [&](const auto& rule) {
    return rule.critical_tolerance > 0 &&
           is_critical(*setting.critical, *setting.initial_void_ratio, rule.critical_tolerance, before, row);
  });
}

void LegRun::write() {
  if (row.step == last_written) return;
  last_written = row.step;
  setting.sink(row);
  row.effort = {};
}

void LegRun::fail(const Leg& leg, const std::string& why) const {
  throw std::runtime_error(fmt::format("{}: stage {} '{}', step {}{}: {}", stage.where, row.stage, stage.name,
                                       row.step, leg.place, why));
}

LegEnd LegRun::run(const Leg& leg, bool from_elastic) {
  if (from_elastic) stiffness = setting.material.elastic_stiffness(row.point);
  if (!stiffness.allFinite())
    fail(leg, "no elastic stiffness from the data check; " + setting.material.evidence(setting.failed_point));
  const bool watched = !stage.stops.empty() || !leg.limits.empty();
  IncrementStart increment;
  for (long i = 0; i < leg.increments; ++i) {
    if (row.step > 0 && row.step % stage.output_every == 0) write();
    increment.from = double(i) / double(leg.increments);
    if (watched) increment.before = row, increment.tangent = stiffness;
    double to = double(i + 1) / double(leg.increments);
    ++row.step;
    if (const auto report = advance_row(leg, increment.from, to, row, stiffness); !report.converged) {
      setting.sink(row);
      fail(leg, failure_text(setting, stage, report));
    }
    if (!watched) continue;
    for (const auto* bounds : {&leg.limits, &stops})
      for (const auto& bound : *bounds) // each keeps the end or moves it back
        if (bound.excess(row) > 0) end_on(bound, leg, increment, to);
    if (passed(stops) || critical_since(increment.before)) return LegEnd::stop;
    if (passed(leg.limits)) return LegEnd::limit;
  }
  return LegEnd::completed;
}

} // namespace drivers
