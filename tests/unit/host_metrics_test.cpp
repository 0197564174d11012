// SPDX-License-Identifier: BSD-3-Clause
// Outline, height, front and volume of bodies whose shape is known.
#include "host/bodies/initial_particles.hpp"
#include "host/engine/metrics.hpp"
#include "host/scheme/geometry.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace host;

constexpr double spacing = 0.002, radius = 25 * spacing, height = 20 * spacing, density = 1500;
const Kernel<2> kernel(1.5 * spacing);

template <class Geometry> Particles<Geometry> column() {
  Scene scene;
  scene.spacing = spacing;
  scene.column = {radius, height};
  scene.bulk_density = density;
  return initial_particles<Geometry>(scene);
}

/// Copies of the particles with one more of the lattice's volume.
template <class Geometry> Particles<Geometry> with_stray(const Particles<Geometry>& p, double x, double y) {
  Particles<Geometry> out;
  out.resize(p.count + 1, 0);
  for (int i = 0; i <= p.count; ++i) {
    const bool stray = i == p.count;
    out.position[0][i] = stray ? x : p.position[0][i];
    out.position[1][i] = stray ? y : p.position[1][i];
    out.density[i] = density;
    out.mass[i] = stray ? density * spacing * spacing * Geometry::depth * Geometry::weight(x) : p.mass[i];
  }
  return out;
}

template <class Geometry> void expect_column() {
  const auto p = column<Geometry>();
  const auto radii = outline_radii(spacing, 2 * radius);
  const auto heights = outline(p, kernel, radii);
  EXPECT_NEAR(outline_height(heights), height, 0.02 * spacing);
  for (std::size_t k = 0; radii[k] < radius - kernel.support; ++k)
    EXPECT_NEAR(heights[k], height, 0.02 * spacing) << "at " << radii[k];
  EXPECT_NEAR(front_radius(radii, heights, 0.5 * height), radius, 0.5 * spacing);
  // Samples stand half a spacing apart: the edge is known to a quarter. Its corner is rounded.
  const double exact = Geometry::hoop ? std::numbers::pi * radius * radius * height : radius * height;
  const double edge = Geometry::depth * Geometry::weight(radius), h = kernel.h;
  EXPECT_NEAR(outline_volume<Geometry>(radii, heights), exact,
              edge * (0.25 * spacing * height + 0.5 * h * h));
}

TEST(Metrics, OfAColumn) {
  expect_column<PlaneStrain>();
  expect_column<Axisymmetric>();
}

/// A body of profile `height (1 - x / radius)`, in columns of particles that fill it exactly.
template <class Geometry> Particles<Geometry> cone(double low, double wide) {
  std::vector<std::array<double, 3>> points; // x, y, area
  for (double x = 0.5 * spacing; x < wide; x += spacing) {
    const double top = low * (1 - x / wide);
    const int rows = std::max(1, int(std::lround(top / spacing)));
    for (int k = 0; k < rows; ++k) points.push_back({x, (k + 0.5) * top / rows, spacing * top / rows});
  }
  Particles<Geometry> p;
  p.resize(int(points.size()), 0);
  for (int i = 0; i < p.count; ++i) {
    const auto [x, y, area] = points[i];
    p.position[0][i] = x;
    p.position[1][i] = y;
    p.density[i] = density;
    p.mass[i] = density * area * Geometry::depth * Geometry::weight(x);
  }
  return p;
}

TEST(Metrics, OfACone) {
  const double low = 30 * spacing, wide = 100 * spacing, grain = 1.5 * spacing;
  const auto p = cone<Axisymmetric>(low, wide);
  const auto radii = outline_radii(spacing, 2 * wide);
  const auto heights = outline(p, kernel, radii);
  for (std::size_t k = 0; radii[k] < 0.9 * wide; ++k) {
    if (radii[k] < kernel.support) continue;
    EXPECT_NEAR(heights[k], low * (1 - radii[k] / wide), 0.1 * spacing) << "at " << radii[k];
  }
  EXPECT_NEAR(outline_height(heights), low, 0.5 * spacing) << "the tip is rounded";
  // Where the cone is a grain high; a tenth of a spacing in height is a third of one along the slope.
  EXPECT_NEAR(front_radius(radii, heights, grain), wide * (1 - grain / low), spacing);
  const double exact = std::numbers::pi * wide * wide * low / 3;
  EXPECT_NEAR(outline_volume<Axisymmetric>(radii, heights), exact, 0.01 * exact);
}

TEST(Metrics, AStrayGrainIsIgnored) {
  const auto radii = outline_radii(spacing, 3 * radius);
  const auto p = column<PlaneStrain>();
  const auto heights = outline(p, kernel, radii);
  const std::array<double, 2> places[] = {
      {0.4 * radius, height + 12 * spacing}, {2 * radius, 0.5 * spacing}, {2 * radius, 15 * spacing}};
  for (const auto& [x, y] : places) {
    const auto seen = outline(with_stray(p, x, y), kernel, radii);
    for (std::size_t k = 0; k < radii.size(); ++k) EXPECT_NEAR(seen[k], heights[k], 1e-6 * spacing);
    EXPECT_NEAR(front_radius(radii, seen, spacing), front_radius(radii, heights, spacing), 1e-6 * spacing);
  }
}

const Kernel<3> solid_kernel(1.5 * spacing);

Particles<ThreeDimensional> solid_column(Sector sector) {
  Scene scene;
  scene.geometry = GeometryKind::three_dimensional;
  scene.sector = sector;
  scene.spacing = spacing;
  scene.column = {14 * spacing, 8 * spacing};
  scene.bulk_density = density;
  return initial_particles<ThreeDimensional>(scene);
}

TEST(Metrics, OfACylinderAndItsSectors) {
  const double wide = 14 * spacing, high = 8 * spacing;
  const auto radii = outline_radii(spacing, 2 * wide);
  for (const Sector sector : {Sector::full, Sector::half, Sector::quarter}) {
    const auto profiles = surface_profiles(solid_column(sector), solid_kernel, radii, sector);
    EXPECT_EQ(profiles.size(), sector == Sector::full ? 32 : (sector == Sector::half ? 16 : 8));
    const auto heights = mean_profile(profiles);
    for (std::size_t k = 0; radii[k] < wide - solid_kernel.support; ++k)
      EXPECT_NEAR(heights[k], high, (radii[k] < 4 * spacing ? 0.2 : 0.05) * spacing) << "at " << radii[k];
    const auto front = front_of(profiles, radii, 0.5 * high);
    EXPECT_NEAR(front.mean, wide, 0.5 * spacing);
    EXPECT_LT(front.scatter, 0.05 * spacing);
    const double exact = std::numbers::pi * wide * wide * high * fraction(sector);
    EXPECT_NEAR(outline_volume<ThreeDimensional>(radii, heights, sector), exact, 0.05 * exact);
  }
}

TEST(Metrics, TheFrontOfAnEllipseScattersOverTheAzimuths) {
  constexpr double stretch = 1.25, wide = 14 * spacing;
  auto p = solid_column(Sector::full);
  for (int i = 0; i < p.count; ++i) {
    p.position[0][i] *= stretch;
    p.density[i] /= stretch;
  }
  const auto radii = outline_radii(spacing, 2 * wide);
  const auto front = front_of(surface_profiles(p, solid_kernel, radii), radii, 4 * spacing);
  double sum = 0, squares = 0;
  for (int k = 0; k < 32; ++k) {
    const double angle = (k + 0.5) * std::numbers::pi / 16;
    const double r = wide / std::hypot(std::cos(angle) / stretch, std::sin(angle));
    sum += r / 32;
    squares += r * r / 32;
  }
  EXPECT_NEAR(front.mean, sum, 0.3 * spacing);
  EXPECT_NEAR(front.scatter, std::sqrt(squares - sum * sum), 0.1 * spacing);
}

TEST(Metrics, FrontAndVolumeOfStraightLinesAreExact) {
  const std::vector<double> radii{0, 1, 2, 3, 4}, level{5, 5, 5, 5, 5}, slope{4, 3, 2, 1, 0};
  EXPECT_DOUBLE_EQ(outline_volume<PlaneStrain>(radii, level), 20);
  EXPECT_DOUBLE_EQ(outline_volume<Axisymmetric>(radii, level), std::numbers::pi * 16 * 5);
  EXPECT_DOUBLE_EQ(outline_volume<PlaneStrain>(radii, slope), 8);
  EXPECT_DOUBLE_EQ(front_radius(radii, slope, 0.25), 3.75);
  EXPECT_DOUBLE_EQ(front_radius(radii, slope, 5), 0);
  EXPECT_TRUE(std::isnan(front_radius(radii, level, 1))) << "past the last radius";
  EXPECT_DOUBLE_EQ(outline_height(slope), 4);
}

TEST(Metrics, SpreadIsOfTheParticlesThatCarry) {
  Particles<PlaneStrain> p;
  p.resize(3, 0);
  const double pressures[] = {10, 100, 200}, quantity[] = {9, 1, 4};
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) p.stress[c][i] = -pressures[i];
    p.mass[i] = i;
  }
  const auto spread = spread_of(p, quantity, 20);
  EXPECT_EQ(spread.particles, 2);
  EXPECT_EQ(spread.least, 1);
  EXPECT_EQ(spread.most, 4);
  EXPECT_DOUBLE_EQ(spread.mean, 3);
  EXPECT_EQ(spread_of(p, quantity, 1000).particles, 0);
}

} // namespace
