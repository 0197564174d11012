// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/leg_run.hpp"
#include <fmt/format.h>

namespace drivers {
namespace {

void run_straight(LegRun& run) {
  const long n = run.stage.increments;
  run.run({run.control, n, run.stage.duration, {}, fmt::format(" of {}", n)});
  run.write();
}

/// Loading in one direction until a limit is met, or to the largest number of increments.
Leg half_cycle(const LegRun& run, long number) {
  const auto& c = *run.stage.cycling;
  const bool upwards = (number % 2 == 0) == c.upwards;
  Leg leg{run.control, c.leg_increments, run.stage.duration * double(c.leg_increments),
          bounds_of(c, upwards, run.start), fmt::format(", leg {} of {}", number + 1, 2 * c.cycles)};
  leg.control.change.setZero();
  leg.control.change[0] = (upwards ? 1 : -1) * c.increment * double(c.leg_increments);
  leg.control.at_start[0] = run.stage.conditions.front().at(run.row.point.stress, run.row.point.strain);
  return leg;
}

void run_cycles(LegRun& run) {
  const auto& c = *run.stage.cycling;
  for (long number = 0; number < 2 * c.cycles; ++number) {
    run.reversal_strain = c.strain->weights.dot(run.row.point.strain);
    const auto leg = half_cycle(run, number);
    const auto end = run.run(leg, true);
    if (end == LegEnd::limit) run.row.cycles += 0.5;
    run.write();
    if (end == LegEnd::stop) return;
    if (end == LegEnd::completed) run.fail(leg, fmt::format("no limit met in {} increments", leg.increments));
  }
}

/// Changes of the driven quantities since the start of the stage, at a row of the measured path.
std::vector<double> changes(const LegRun& run, const MeasuredRow& row) {
  auto to = row.targets;
  for (std::size_t c = 0; c < to.size(); ++c)
    if (!run.stage.measured->driven[c]->is_strain) to[c] -= run.control.at_start[Eigen::Index(c)];
  return to;
}

void run_replay(LegRun& run) {
  const auto& r = *run.stage.measured;
  std::vector<double> from(r.driven.size(), 0.0);
  for (std::size_t k = 0; k < r.rows.size(); ++k) {
    const auto to = changes(run, r.rows[k]);
    Leg leg{run.control, r.increments(from, to), run.stage.duration / double(r.rows.size()), {}, ""};
    leg.place = fmt::format(", row of {}:{}", r.file, r.rows[k].line);
    if (r.timed && k > 0) leg.duration = r.rows[k].time - r.rows[k - 1].time;
    leg.control.change.setZero();
    for (std::size_t c = 0; c < to.size(); ++c) {
      leg.control.at_start[Eigen::Index(c)] += from[c];
      leg.control.change[Eigen::Index(c)] = to[c] - from[c];
    }
    const auto end = run.run(leg);
    run.write();
    if (end == LegEnd::stop) return;
    from = to;
  }
}

} // namespace

void run_stage(const StageSetting& setting, const Stage& stage, ElementRow& row) {
  ++row.stage;
  row.step = 0;
  row.cycles = row.double_amplitude = row.pore_pressure_ratio = 0;
  row.effort = {};
  LegRun run(setting, stage, row);
  if (stage.cycling)
    run_cycles(run);
  else if (stage.measured)
    run_replay(run);
  else
    run_straight(run);
}

} // namespace drivers
