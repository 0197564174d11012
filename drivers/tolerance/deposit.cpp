// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tolerance/deposit.hpp"
#include "host/files/hdf5_read.hpp"
#include "host/files/result_read.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace drivers {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// Runs `read` on the open file and turns HDF5's exceptions into one line.
template <class Read> auto reading(const std::filesystem::path& path, const Read& read) {
  H5::Exception::dontPrint();
  try {
    return read(host::open_to_read(path));
  } catch (const H5::Exception& error) {
    fail(path, "cannot be read: " + error.getDetailMsg());
  }
}

/// The last `count` values: the final row of a table of rows.
std::vector<double> last(const std::vector<double>& values, std::size_t count) {
  return {values.end() - std::ptrdiff_t(count), values.end()};
}

} // namespace

double Outline::at(double radius) const {
  const auto above = std::upper_bound(radii.begin(), radii.end(), radius);
  if (above == radii.end()) return radius == radii.back() ? heights.back() : 0;
  if (above == radii.begin()) return heights.front();
  const auto k = std::size_t(above - radii.begin());
  const double part = (radius - radii[k - 1]) / (radii[k] - radii[k - 1]);
  return heights[k - 1] + part * (heights[k] - heights[k - 1]);
}

Deposit read_deposit(const std::filesystem::path& result) {
  const auto run = host::read_stored_run(result);
  if (run.checkpoint || !run.complete || run.snapshots == 0) fail(result, "expected a complete result");
  const auto value = [&](const std::string& name) {
    for (const auto& [quantity, number] : run.summary)
      if (quantity.name == name) return number;
    return std::numeric_limits<double>::quiet_NaN();
  };
  Deposit d{value("final_height"),
            1 + value("runout"),
            value("time_to_rest"),
            run.particles,
            run.steps,
            value("time_processor"),
            0,
            {}};
  d.rate = d.particles * d.steps / d.seconds;
  d.outline = reading(result, [&](const H5::H5File& file) {
    return Outline{host::read_array<double>(file, "outline/r"),
                   host::read_array<double>(file, fmt::format("snapshots/{:04}/outline", run.snapshots - 1))};
  });
  return d;
}

Deposit read_dem_deposit(const std::filesystem::path& path, double radius) {
  return reading(path, [&](const H5::H5File& file) {
    Deposit d;
    d.height = host::read_array<double>(file, "height/surface").back() / radius;
    d.radius = host::read_array<double>(file, "front/one_grain").back() / radius;
    d.rest = std::numeric_limits<double>::quiet_NaN();
    d.outline.radii = host::read_array<double>(file, "outline/radius");
    d.outline.heights = last(host::read_array<double>(file, "outline/height"), d.outline.radii.size());
    return d;
  });
}

Outline mean_outline(const std::vector<Outline>& outlines) {
  Outline mean = outlines.front();
  for (std::size_t k = 0; k < mean.radii.size(); ++k) {
    double sum = 0;
    for (const auto& outline : outlines) sum += outline.at(mean.radii[k]);
    mean.heights[k] = sum / double(outlines.size());
  }
  return mean;
}

double area_between(const Outline& a, const Outline& b) {
  constexpr int parts = 4000;
  const double end = std::max(a.radii.back(), b.radii.back()), step = end / parts;
  double area = 0;
  for (int k = 0; k < parts; ++k) area += std::abs(a.at((k + 0.5) * step) - b.at((k + 0.5) * step)) * step;
  return area;
}

} // namespace drivers
