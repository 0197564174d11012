// SPDX-License-Identifier: BSD-3-Clause
// The cheapest configuration that the chart's data expect to meet a tolerance, and how far its result may be off.
#pragma once
#include "drivers/tolerance/chart_data.hpp"
#include <optional>

namespace drivers {

/// Part of resolution between a run and its coarser companion.
inline constexpr double companion_ratio = 1.6;

struct Choice {
  ChartPoint point;
  int meeting = 0, considered = 0;   ///< configurations of the chart
  std::optional<ChartPoint> cheaper; ///< the dearest one that costs less and misses the tolerance
  std::optional<ChartPoint> simple;  ///< the best of the simpler material
};

/// Among the configurations of one flow: those of SIMSAND or a simpler material, with the scheme's own numbers (step factor,
/// smoothing length), without failures, coarser than the finest. One meets the tolerance where the errors of both h_f and
/// r_f are below it in the middle column of the chart, and those of all finer ones of its kind as well, as a small error at one
/// resolution alone is luck. Anything but the default must save a tenth of the cost. Throws std::runtime_error naming the
/// best there is if none meets it.
Choice choose(const ChartData& data, bool plane, double tolerance);

/// Both errors below the tolerance and no run failed.
bool meets(const ChartPoint& point, double tolerance);

/// Half widths of intervals, relative: factor times the root of the squares of the error that the chart has for the
/// configuration and of the difference to the companion.
struct Interval {
  HeightRadius factor;
  int pairs = 0; ///< of runs of the chart that the factors rest on
};

/// Share of the pairs below that intervals hold.
inline constexpr double held_share = 0.8;

/// The factors for which that share of the pairs of a run and a run of about 1.6 times its spacing, of one kind and column,
/// hold the finest run, and not below 1. The chart's error is that of the worst of the other columns, as it will be for a scene
/// that is not in the chart; where the chart has one column only no pair can tell, and the factors are 1.
Interval calibrate_interval(const ChartData& data, bool plane);

/// Half width for one quantity.
double half_width(double factor, double chart_error, double difference);

} // namespace drivers
