// SPDX-License-Identifier: BSD-3-Clause
#include "host/metrics.hpp"
#include "host/geometry.hpp"
#include <algorithm>
#include <limits>

namespace host {
namespace {

/// Particles and their images across axis and floor, those of one vertical strip together.
struct Strips {
  double width;
  std::vector<std::vector<std::array<double, 3>>> points; ///< x, y, area
};

template <class Geometry>
Strips sort_into_strips(const Particles<Geometry>& p, const Kernel<2>& kernel, double largest) {
  Strips strips{kernel.support, {}};
  strips.points.resize(std::size_t(largest / strips.width) + 2);
  for (int i = 0; i < p.count; ++i) {
    const double x = p.position[0][i], y = p.position[1][i];
    const double area = p.mass[i] / (p.density[i] * Geometry::depth * Geometry::weight(x));
    for (const double sx : {x, -x})
      for (const double sy : {y, -y}) {
        if (sx < -kernel.support || sy < -kernel.support) continue;
        const auto strip = std::size_t(std::max(0.0, sx) / strips.width);
        if (strip < strips.points.size()) strips.points[strip].push_back({sx, sy, area});
      }
  }
  return strips;
}

/// Share of the kernel at (x, y) that particles fill.
double filled(const Strips& strips, const Kernel<2>& kernel, double x, double y) {
  const auto middle = std::ptrdiff_t(x / strips.width);
  double sum = 0;
  for (auto s = std::max<std::ptrdiff_t>(0, middle - 1);
       s <= std::min<std::ptrdiff_t>(middle + 1, std::ptrdiff_t(strips.points.size()) - 1); ++s)
    for (const auto& [px, py, area] : strips.points[s]) {
      const double square = (px - x) * (px - x) + (py - y) * (py - y);
      if (square < kernel.support * kernel.support) sum += area * kernel.value(std::sqrt(square));
    }
  return sum;
}

double height_at(const Strips& strips, const Kernel<2>& kernel, double x) {
  const auto middle = std::ptrdiff_t(x / strips.width);
  double top = 0;
  for (auto s = std::max<std::ptrdiff_t>(0, middle - 1);
       s <= std::min<std::ptrdiff_t>(middle + 1, std::ptrdiff_t(strips.points.size()) - 1); ++s)
    for (const auto& point : strips.points[s])
      if (std::abs(point[0] - x) < kernel.support) top = std::max(top, point[1]);
  // Down from above the uppermost particle to the first filled point, then bisection.
  const double stride = 0.25 * kernel.h;
  double above = top + kernel.h, below = above;
  while (below > 0 && filled(strips, kernel, x, below) < 0.5) {
    above = below;
    below -= stride;
  }
  if (below <= 0) {
    if (filled(strips, kernel, x, 0) < 0.5) return 0;
    below = 0;
  }
  for (int k = 0; k < 30; ++k) {
    const double between = 0.5 * (above + below);
    (filled(strips, kernel, x, between) < 0.5 ? above : below) = between;
  }
  return 0.5 * (above + below);
}

} // namespace

std::vector<double> outline_radii(double spacing, double largest) {
  std::vector<double> radii(std::size_t(largest / (0.5 * spacing)) + 1);
  for (std::size_t k = 0; k < radii.size(); ++k) radii[k] = 0.5 * spacing * double(k);
  return radii;
}

template <class Geometry>
std::vector<double> outline(const Particles<Geometry>& p, const Kernel<2>& kernel,
                            std::span<const double> radii) {
  const Strips strips = sort_into_strips(p, kernel, radii.back());
  std::vector<double> heights(radii.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t k = 0; k < radii.size(); ++k) heights[k] = height_at(strips, kernel, radii[k]);
  return heights;
}

double outline_height(std::span<const double> outline) {
  return *std::ranges::max_element(outline);
}

double front_radius(std::span<const double> radii, std::span<const double> outline, double thickness) {
  for (std::size_t k = radii.size(); k-- > 0;)
    if (outline[k] >= thickness) {
      if (k + 1 == radii.size()) return std::numeric_limits<double>::quiet_NaN();
      const double t = (outline[k] - thickness) / (outline[k] - outline[k + 1]);
      return radii[k] + t * (radii[k + 1] - radii[k]);
    }
  return 0;
}

template <class Geometry>
double outline_volume(std::span<const double> radii, std::span<const double> outline) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < radii.size(); ++k)
    sum += 0.5 * (radii[k + 1] - radii[k]) *
           (Geometry::weight(radii[k]) * outline[k] + Geometry::weight(radii[k + 1]) * outline[k + 1]);
  return Geometry::depth * sum;
}

template <class Geometry>
Spread spread_of(const Particles<Geometry>& p, std::span<const double> quantity, double least_pressure) {
  Spread spread{nowhere, 0, -nowhere, 0};
  double mass = 0;
  for (int i = 0; i < p.count; ++i) {
    if (mean_pressure(p, i) < least_pressure) continue;
    ++spread.particles;
    spread.least = std::min(spread.least, quantity[i]);
    spread.most = std::max(spread.most, quantity[i]);
    spread.mean += p.mass[i] * quantity[i];
    mass += p.mass[i];
  }
  if (spread.particles == 0) return {};
  spread.mean /= mass;
  return spread;
}

template std::vector<double> outline(const Particles<PlaneStrain>&, const Kernel<2>&,
                                     std::span<const double>);
template std::vector<double> outline(const Particles<Axisymmetric>&, const Kernel<2>&,
                                     std::span<const double>);
template double outline_volume<PlaneStrain>(std::span<const double>, std::span<const double>);
template double outline_volume<Axisymmetric>(std::span<const double>, std::span<const double>);
template Spread spread_of(const Particles<PlaneStrain>&, std::span<const double>, double);
template Spread spread_of(const Particles<Axisymmetric>&, std::span<const double>, double);

} // namespace host
