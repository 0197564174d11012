// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/choice.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

/// Numbers of the scheme that a run with a tolerance leaves alone.
bool has_usual_scheme(const Configuration& c) {
  const Configuration usual;
  return c.step_factor == usual.step_factor && c.kernel == usual.kernel &&
         c.smoothing_length == usual.smoothing_length;
}

bool is_offered(const ChartPoint& p, bool plane, double finest) {
  const auto& c = p.configuration;
  return is_plane(c) == plane && has_usual_scheme(c) && c.material != "calibrated" && c.resolution < finest;
}

/// Cost with a tenth on top of what departs from the default.
double price(const ChartPoint& p) {
  auto usual = at_resolution({}, p.configuration.resolution);
  usual.geometry = is_plane(p.configuration) ? "plane_strain" : usual.geometry;
  return p.seconds * (p.configuration == usual ? 1 : 1.1);
}

std::vector<ChartPoint> offered(const ChartData& data, bool plane) {
  std::vector<ChartPoint> points;
  for (const auto& p : data.points())
    if (is_offered(p, plane, data.finest(plane))) points.push_back(p);
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return price(a) < price(b); });
  return points;
}

bool meets_from_here(const std::vector<ChartPoint>& points, const ChartPoint& point, double tolerance) {
  return std::all_of(points.begin(), points.end(), [&](const ChartPoint& other) {
    const bool finer = other.configuration.resolution >= point.configuration.resolution;
    const bool same_kind = at_resolution(other.configuration, 0) == at_resolution(point.configuration, 0);
    return !(finer && same_kind) || meets(other, tolerance);
  });
}

[[noreturn]] void refuse(const std::vector<ChartPoint>& points, double tolerance) {
  const ChartPoint* best = nullptr;
  for (const auto& p : points)
    if (p.failures == 0 && (!best || p.typical.larger() < best->typical.larger())) best = &p;
  if (!best) throw std::runtime_error("--tolerance: the chart's data hold no configuration for this flow");
  throw std::runtime_error(fmt::format("--tolerance {:.3g}%: expected a tolerance that the chart's data can "
                                       "promise, found none that meets it; the best is "
                                       "{:.2g}%, by {}, {:g} particles a side",
                                       100 * tolerance, 100 * best->typical.larger(),
                                       described(best->configuration), best->configuration.resolution));
}

/// The value below which the share of `held_share` lies; at least 1.
double factor_of(std::vector<double> values) {
  if (values.empty()) return 1;
  std::sort(values.begin(), values.end());
  const auto held = std::size_t(std::ceil(held_share * double(values.size())));
  return std::max(1.0, values[std::min(values.size(), held) - 1]);
}

bool are_companions(const Configuration& fine, const Configuration& coarse) {
  const double ratio = fine.resolution / coarse.resolution;
  return at_resolution(fine, 0) == at_resolution(coarse, 0) && ratio > 1.45 && ratio < 1.75;
}

} // namespace

bool meets(const ChartPoint& p, double tolerance) {
  return p.failures == 0 && p.typical.larger() <= tolerance;
}

Choice choose(const ChartData& data, bool plane, double tolerance) {
  const auto points = offered(data, plane);
  Choice choice;
  choice.considered = int(points.size());
  const ChartPoint* found = nullptr;
  for (const auto& p : points) {
    const bool good = meets_from_here(points, p, tolerance);
    choice.meeting += good;
    if (good && !found) found = &p;
    if (!good && !found) choice.cheaper = p;
    const bool simpler = p.configuration.material != "simsand";
    if (simpler && (!choice.simple || p.typical.larger() < choice.simple->typical.larger()))
      choice.simple = p;
  }
  if (!found) refuse(points, tolerance);
  choice.point = *found;
  return choice;
}

Interval calibrate_interval(const ChartData& data, bool plane) {
  std::vector<double> heights, radii;
  const auto add = [](std::vector<double>& ratios, double error, double chart, double fine, double coarse) {
    ratios.push_back(std::abs(error) / half_width(1, chart, coarse / fine - 1));
  };
  for (const auto& fine : data.rows()) {
    if (fine.failed || is_plane(fine.configuration) != plane || !has_usual_scheme(fine.configuration) ||
        fine.configuration.resolution >= data.finest(plane) || fine.configuration.material != "simsand")
      continue;
    const auto error = data.error(fine);
    const auto chart = data.worst_error(fine.configuration, fine.column);
    if (!std::isfinite(chart.height)) continue; // no other column
    for (const auto& coarse : data.rows()) {
      if (coarse.failed || coarse.column != fine.column ||
          !are_companions(fine.configuration, coarse.configuration))
        continue;
      add(heights, error.height, chart.height, fine.height, coarse.height);
      add(radii, error.radius, chart.radius, fine.radius, coarse.radius);
    }
  }
  return {{factor_of(heights), factor_of(radii)}, int(heights.size())};
}

double half_width(double factor, double chart_error, double difference) {
  return factor * std::hypot(chart_error, difference);
}

} // namespace drivers
