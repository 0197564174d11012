// SPDX-License-Identifier: BSD-3-Clause
// The column at its start: its mass, its stress, its places.
#include "host/geometry.hpp"
#include "host/lattice.hpp"
#include <gtest/gtest.h>
#include <numbers>
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
  const auto p = make_column<Geometry>(s);
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

TEST(Lattice, StartsGeostaticHalfASpacingInside) {
  const auto s = scene();
  const auto p = make_column<Axisymmetric>(s);
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
    EXPECT_EQ(p.initial_position[0][i], x);
  }
  EXPECT_EQ(ids.size(), std::size_t(p.count));
  EXPECT_EQ(*ids.rbegin(), p.count - 1);
}

/// The error of a column, empty if there was none.
std::string error_of(double radius, double height) {
  auto s = scene();
  s.column = {radius, height};
  try {
    make_column<PlaneStrain>(s);
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
}

} // namespace
