// SPDX-License-Identifier: BSD-3-Clause
// What the chart keeps of a collapse, by this program or by discrete elements: height, radius, outline, cost.
#pragma once
#include <filesystem>
#include <vector>

namespace drivers {

/// A curve of heights over radii, m.
struct Outline {
  std::vector<double> radii, heights;
  /// Linear between the radii, 0 beyond them.
  double at(double radius) const;
};

struct Deposit {
  double height = 0, radius = 0;                ///< h_f and r_f over the initial radius
  double rest = 0;                              ///< s; NaN: not at rest
  double particles = 0, steps = 0, seconds = 0; ///< seconds: of processor
  double rate = 0;                              ///< particle-steps per second of processor
  Outline outline;                              ///< final
};

/// Throws std::runtime_error naming the file if it is no complete result.
Deposit read_deposit(const std::filesystem::path& result);

/// A column of data/dem/results: mean surface near the axis, radius where the deposit is one grain high. `radius` is
/// the initial one, m. Throws std::runtime_error naming the file.
Deposit read_dem_deposit(const std::filesystem::path& file, double radius);

/// The mean of several outlines, over the radii of the first.
Outline mean_outline(const std::vector<Outline>& outlines);

/// Area between two outlines, m2.
double area_between(const Outline& a, const Outline& b);

} // namespace drivers
