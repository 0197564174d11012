// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/metrics.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace host {
namespace {

/// Particles and their images across planes of symmetry and the floor, in vertical cells of one support width.
template <int D> struct Cells {
  static constexpr int H = D - 1; ///< horizontal coordinates
  struct Particle {
    std::array<double, H> horizontal;
    double height, volume;
  };
  double width, lower;
  int across;
  std::vector<std::vector<Particle>> cell;

  /// From `smallest` (three dimensions: -largest) to `largest`, m.
  Cells(double width, double smallest, double largest)
      : width(width), lower(H == 1 ? smallest : -largest), across(int((largest - lower) / width) + 2),
        cell(H == 1 ? across : across * across) {}

  int along(double x) const { return int(std::max(0.0, x - lower) / width); }

  /// Particles beyond `largest` are left out.
  void add(const Particle& particle) {
    int index = 0;
    for (int a = H - 1; a >= 0; --a) {
      if (along(particle.horizontal[a]) >= across) return;
      index = index * across + along(particle.horizontal[a]);
    }
    cell[index].push_back(particle);
  }
};

template <class Geometry>
Cells<Geometry::dimension> sort_into_cells(const Particles<Geometry>& p, double support, double smallest,
                                           double largest, Sector sector) {
  constexpr int D = Geometry::dimension, H = D - 1;
  const int planes = D == 2 ? smallest >= 0 : symmetry_planes(sector);
  Cells<D> cells(support, smallest, largest);
  for (int i = 0; i < p.count; ++i) {
    const double volume = p.mass[i] / (p.density[i] * Geometry::depth * Geometry::weight(p.position[0][i]));
    for (int image = 0; image < 1 << (planes + 1); ++image) { // the lowest bit is the floor's
      typename Cells<D>::Particle particle{{}, p.position[H][i] * (image & 1 ? -1 : 1), volume};
      bool near = particle.height >= -support;
      for (int a = 0; a < H; ++a) {
        particle.horizontal[a] = p.position[a][i] * (image >> (a + 1) & 1 ? -1 : 1);
        if (a < planes && particle.horizontal[a] < -support) near = false;
      }
      if (near) cells.add(particle);
    }
  }
  return cells;
}

/// A particle within the support of a vertical line.
struct NearLine {
  double height, square, volume; ///< square of the distance from the line, m2
};

/// All of them, the highest first.
template <int D> std::vector<NearLine> along_line(const Cells<D>& cells, const std::array<double, D - 1>& x) {
  std::vector<NearLine> near;
  const auto visit = [&](const std::vector<typename Cells<D>::Particle>& cell) {
    for (const auto& particle : cell) {
      double square = 0;
      for (int a = 0; a < D - 1; ++a)
        square += (particle.horizontal[a] - x[a]) * (particle.horizontal[a] - x[a]);
      if (square < cells.width * cells.width) near.push_back({particle.height, square, particle.volume});
    }
  };
  const auto first = [&](int a) { return std::max(0, cells.along(x[a]) - 1); };
  const auto last = [&](int a) { return std::min(cells.across - 1, cells.along(x[a]) + 1); };
  if constexpr (D == 2)
    for (int i = first(0); i <= last(0); ++i) visit(cells.cell[i]);
  else
    for (int j = first(1); j <= last(1); ++j)
      for (int i = first(0); i <= last(0); ++i) visit(cells.cell[j * cells.across + i]);
  std::ranges::stable_sort(near, [](const NearLine& a, const NearLine& b) { return a.height > b.height; });
  return near;
}

/// Share of the kernel at `height` on the line that is filled by particles.
template <int D> double filled(const std::vector<NearLine>& near, const Kernel<D>& kernel, double height) {
  const double reach = kernel.support;
  auto j = std::ranges::partition_point(near, [&](const NearLine& n) { return n.height >= height + reach; });
  double sum = 0;
  for (; j != near.end() && j->height > height - reach; ++j) {
    const double square = j->square + (j->height - height) * (j->height - height);
    if (square < reach * reach) sum += j->volume * kernel.value(std::sqrt(square));
  }
  return sum;
}

template <int D>
double height_at(const Cells<D>& cells, const Kernel<D>& kernel, const std::array<double, D - 1>& x) {
  const auto near = along_line(cells, x);
  // Down from above the uppermost particle to the first filled point, then bisection.
  const double stride = 0.25 * kernel.h;
  double above = std::max(near.empty() ? 0 : near.front().height, 0.0) + kernel.h, below = above;
  while (below > 0 && filled(near, kernel, below) < 0.5) {
    above = below;
    below -= stride;
  }
  if (below <= 0) {
    if (filled(near, kernel, 0) < 0.5) return 0;
    below = 0;
  }
  for (int k = 0; k < 30; ++k) {
    const double between = 0.5 * (above + below);
    (filled(near, kernel, between) < 0.5 ? above : below) = between;
  }
  return 0.5 * (above + below);
}

/// Azimuths, rad, at which a sector is looked at: a fixed number in each quarter, none on a plane of symmetry.
std::vector<double> azimuths(Sector sector) {
  constexpr int in_quarter = 8;
  const double start = sector == Sector::half ? -std::numbers::pi / 2 : 0;
  std::vector<double> angles(in_quarter * (4 >> symmetry_planes(sector)));
  for (std::size_t k = 0; k < angles.size(); ++k)
    angles[k] = start + (double(k) + 0.5) / in_quarter * std::numbers::pi / 2;
  return angles;
}

} // namespace

std::vector<double> outline_radii(double spacing, double largest, double smallest) {
  std::vector<double> radii(std::size_t((largest - smallest) / (0.5 * spacing)) + 1);
  for (std::size_t k = 0; k < radii.size(); ++k) radii[k] = smallest + 0.5 * spacing * double(k);
  return radii;
}

template <class Geometry>
Profiles surface_profiles(const Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                          std::span<const double> radii, Sector sector) {
  constexpr int D = Geometry::dimension;
  const auto cells = sort_into_cells(p, kernel.support, radii.front(), radii.back(), sector);
  const auto angles = D == 2 ? std::vector{0.0} : azimuths(sector);
  Profiles profiles(angles.size(), std::vector<double>(radii.size()));
#pragma omp parallel for schedule(dynamic, 8) collapse(2)
  for (std::size_t m = 0; m < angles.size(); ++m)
    for (std::size_t k = 0; k < radii.size(); ++k)
      if constexpr (D == 2)
        profiles[m][k] = height_at(cells, kernel, {radii[k]});
      else
        profiles[m][k] =
            height_at(cells, kernel, {radii[k] * std::cos(angles[m]), radii[k] * std::sin(angles[m])});
  return profiles;
}

std::vector<double> mean_profile(const Profiles& profiles) {
  std::vector<double> mean = profiles.front();
  if (profiles.size() == 1) return mean;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    double sum = 0;
    for (const auto& profile : profiles) sum += profile[k];
    mean[k] = sum / double(profiles.size());
  }
  return mean;
}

Front front_of(const Profiles& profiles, std::span<const double> radii, double thickness) {
  double sum = 0, squares = 0;
  for (const auto& profile : profiles) {
    const double radius = front_radius(radii, profile, thickness);
    sum += radius;
    squares += radius * radius;
  }
  const double n = double(profiles.size()), mean = sum / n;
  return {mean, profiles.size() == 1 ? 0 : std::sqrt(std::max(squares / n - mean * mean, 0.0))};
}

template <class Geometry>
std::vector<double> outline(const Particles<Geometry>& p, const Kernel<Geometry::dimension>& kernel,
                            std::span<const double> radii, Sector sector) {
  return mean_profile(surface_profiles(p, kernel, radii, sector));
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
double outline_volume(std::span<const double> radii, std::span<const double> outline, Sector sector) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < radii.size(); ++k)
    sum += 0.5 * (radii[k + 1] - radii[k]) *
           (Geometry::weight_of_outline(radii[k]) * outline[k] +
            Geometry::weight_of_outline(radii[k + 1]) * outline[k + 1]);
  return Geometry::depth_of_outline * fraction(sector) * sum;
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

template decltype(surface_profiles<PlaneStrain>) surface_profiles<PlaneStrain>;
template decltype(surface_profiles<Axisymmetric>) surface_profiles<Axisymmetric>;
template decltype(surface_profiles<ThreeDimensional>) surface_profiles<ThreeDimensional>;
template decltype(outline<PlaneStrain>) outline<PlaneStrain>;
template decltype(outline<Axisymmetric>) outline<Axisymmetric>;
template decltype(outline<ThreeDimensional>) outline<ThreeDimensional>;
template decltype(outline_volume<PlaneStrain>) outline_volume<PlaneStrain>;
template decltype(outline_volume<Axisymmetric>) outline_volume<Axisymmetric>;
template decltype(outline_volume<ThreeDimensional>) outline_volume<ThreeDimensional>;
template decltype(spread_of<PlaneStrain>) spread_of<PlaneStrain>;
template decltype(spread_of<Axisymmetric>) spread_of<Axisymmetric>;
template decltype(spread_of<ThreeDimensional>) spread_of<ThreeDimensional>;

} // namespace host
