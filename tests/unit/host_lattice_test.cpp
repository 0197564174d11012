// SPDX-License-Identifier: BSD-3-Clause
// The column at its start: its mass, its stress, its places.
#include "host/bodies/disc.hpp"
#include "host/bodies/initial_particles.hpp"
#include "host/scheme/geometry.hpp"
#include "host/scheme/kernel.hpp"
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <set>

namespace {

using namespace host;

/// 50.7 mm x 31.1 mm: no whole number of spacings.
Scene scene(double spacing = 0.002) {
  Scene s;
  s.spacing = spacing;
  s.gravity = 9.81;
  s.column = {0.0507, 0.0311};
  s.bulk_density = 1730;
  s.earth_pressure_ratio = 0.45;
  s.material.state_variables = 2;
  s.initial_state = {0.6, -3};
  return s;
}

template <class Geometry> double mass_of(const Scene& s) {
  const auto p = initial_particles<Geometry>(s);
  double sum = 0;
  for (int i = 0; i < p.count; ++i) sum += p.mass[i];
  return sum;
}

TEST(Lattice, HoldsTheMassOfTheColumn) {
  for (const double spacing : {0.01, 0.002}) {
    const double half_section = 0.0507 * 0.0311 * 1730, cylinder = std::numbers::pi * 0.0507 * half_section;
    EXPECT_NEAR(mass_of<PlaneStrain>(scene(spacing)), half_section, 1e-12 * half_section);
    EXPECT_NEAR(mass_of<Axisymmetric>(scene(spacing)), cylinder, 1e-12 * cylinder);
  }
}

Scene solid_scene(Sector sector, double spacing = 0.005) {
  auto s = scene(spacing);
  s.geometry = GeometryKind::three_dimensional;
  s.sector = sector;
  return s;
}

TEST(Lattice, HoldsTheMassOfTheSector) {
  const double cylinder = std::numbers::pi * 0.0507 * 0.0507 * 0.0311 * 1730;
  for (const double spacing : {0.01, 0.0031}) {
    EXPECT_NEAR(mass_of<ThreeDimensional>(solid_scene(Sector::full, spacing)), cylinder, 1e-12 * cylinder);
    EXPECT_NEAR(mass_of<ThreeDimensional>(solid_scene(Sector::half, spacing)), cylinder / 2,
                1e-12 * cylinder);
    EXPECT_NEAR(mass_of<ThreeDimensional>(solid_scene(Sector::quarter, spacing)), cylinder / 4,
                1e-12 * cylinder);
  }
}

/// Places in units of a micrometre.
std::set<std::array<long, 3>> places(Sector sector) {
  const auto p = initial_particles<ThreeDimensional>(solid_scene(sector));
  std::set<std::array<long, 3>> all;
  for (int i = 0; i < p.count; ++i)
    all.insert({std::lround(1e6 * p.position[0][i]), std::lround(1e6 * p.position[1][i]),
                std::lround(1e6 * p.position[2][i])});
  EXPECT_EQ(all.size(), std::size_t(p.count));
  return all;
}

TEST(Lattice, ASectorIsThatPartOfTheWhole) {
  std::set<std::array<long, 3>> half, quarter;
  for (const auto& place : places(Sector::full)) {
    if (place[0] > 0) half.insert(place);
    if (place[0] > 0 && place[1] > 0) quarter.insert(place);
  }
  EXPECT_EQ(places(Sector::half), half);
  EXPECT_EQ(places(Sector::quarter), quarter);
}

TEST(Lattice, RingsOfEqualParticlesFillTheDiscEvenly) {
  const auto s = solid_scene(Sector::full, 0.002);
  const auto p = initial_particles<ThreeDimensional>(s);
  const int layer = p.count / 16;
  EXPECT_EQ(p.count % 16, 0);
  EXPECT_NEAR(layer, std::numbers::pi * 25 * 25, 3) << "25 rings";
  double outermost = 0;
  for (int i = 0; i < layer; ++i) {
    EXPECT_EQ(p.mass[i], p.mass[0]);
    double nearest = 1;
    for (int j = 0; j < layer; ++j)
      if (j != i)
        nearest = std::min(
            nearest, std::hypot(p.position[0][i] - p.position[0][j], p.position[1][i] - p.position[1][j]));
    EXPECT_GT(nearest, 0.85 * s.spacing);
    EXPECT_LT(nearest, 1.2 * s.spacing);
    outermost = std::max(outermost, std::hypot(p.position[0][i], p.position[1][i]));
  }
  EXPECT_NEAR(outermost, s.column.radius - 0.5 * s.spacing, 0.05 * s.spacing);
}

/// Largest sum of V grad W over a stack of discs with images behind the wall, times the spacing.
double unevenness(double jitter) {
  constexpr int rings = 12;
  constexpr double h = 1.5;
  const Kernel<3> kernel(h);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  auto places = quarter_disc(rings, h);
  for (auto& place : places)
    for (double& x : place) x += shift(random);
  const double volume = std::numbers::pi * rings * rings / (4.0 * double(places.size()));
  double worst = 0;
  for (const auto& at : places) {
    double sum[2]{};
    for (const auto& [px, py] : places)
      for (int image = 0; image < 8; ++image)
        for (int layer = -3; layer <= 3; ++layer) {
          const double r = std::hypot(px, py), stretch = image & 4 ? (2 * rings - r) / r : 1;
          const double dx = at[0] - (image & 1 ? -px : px) * stretch,
                       dy = at[1] - (image & 2 ? -py : py) * stretch;
          const double w =
              volume * stretch * kernel.gradient_factor(std::sqrt(dx * dx + dy * dy + layer * layer));
          sum[0] += w * dx;
          sum[1] += w * dy;
        }
    worst = std::max(worst, std::hypot(sum[0], sum[1]));
  }
  return worst;
}

TEST(Lattice, AUniformStressPushesNoParticleOfTheDisc) {
  EXPECT_LT(unevenness(0), 0.002);
  EXPECT_GT(unevenness(0.1), 0.05) << "any disorder would push";
}

TEST(Lattice, StartsGeostaticHalfASpacingInside) {
  const auto s = scene();
  const auto p = initial_particles<Axisymmetric>(s);
  ASSERT_EQ(p.count, 25 * 16);
  std::set<int> ids;
  for (int i = 0; i < p.count; ++i) {
    ids.insert(p.id[i]);
    const double x = p.position[0][i], y = p.position[1][i], vertical = -1730 * 9.81 * (0.0311 - y);
    EXPECT_TRUE(x > 0.49 * s.spacing && x < s.column.radius - 0.49 * s.spacing) << x;
    EXPECT_TRUE(y > 0.48 * s.spacing && y < s.column.height - 0.48 * s.spacing) << y;
    EXPECT_NEAR(p.stress[1][i], vertical, 1e-9);
    EXPECT_NEAR(p.stress[0][i], 0.45 * vertical, 1e-9);
    EXPECT_EQ(p.stress[2][i], p.stress[0][i]);
    EXPECT_EQ(p.stress[3][i], 0);
    EXPECT_EQ(p.density[i], 1730);
    EXPECT_EQ(p.state[0][i], 0.6);
    EXPECT_EQ(p.state[1][i], -3);
    EXPECT_EQ(p.velocity[0][i], 0);
  }
  EXPECT_EQ(ids.size(), std::size_t(p.count));
  EXPECT_EQ(*ids.rbegin(), p.count - 1);
}

/// The error of a column, empty if there was none.
template <class Geometry = PlaneStrain> std::string error_of(double radius, double height) {
  auto s = scene();
  s.column = {radius, height};
  try {
    initial_particles<Geometry>(s);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Lattice, AColumnThinnerThanASpacingHoldsNothing) {
  const auto error = error_of(0.0007, 0.03);
  EXPECT_NE(error.find("scene without particles: a column of 0.0007 m x 0.03 m"), std::string::npos) << error;
  EXPECT_NE(error_of(0.03, 0.0007), "");
  EXPECT_NE(error_of(0.0018, 0.03), "") << "thinner than one spacing";
  EXPECT_NE(error_of(0.03, 0.0018), "");
  EXPECT_EQ(error_of(0.002, 0.002), "");
  EXPECT_EQ(error_of<ThreeDimensional>(0.02, 0.002), "");
  EXPECT_NE(error_of<ThreeDimensional>(0.008, 0.02).find("too few particles across the radius"),
            std::string::npos)
      << "a particle would reach the wall from both sides";
}

} // namespace
