// SPDX-License-Identifier: BSD-3-Clause
// Images behind axis, floor and gate: where they stand, what they carry, and that a column in equilibrium
// does not notice that it ends there.
#include "host/geometry.hpp"
#include "host/lattice.hpp"
#include "host/mirrors.hpp"
#include "host/simulation.hpp"
#include <gtest/gtest.h>

namespace {

using namespace host;

constexpr double spacing = 0.002, radius = 20 * spacing, height = 24 * spacing, reach = 3 * spacing; // m

Scene column_scene(GateMotion gate) {
  Scene scene;
  scene.spacing = spacing;
  scene.column = {radius, height};
  scene.bulk_density = 1500;
  scene.earth_pressure_ratio = 0.5;
  scene.gate = {gate, 1.6};
  return scene;
}

/// A column at rest as a step sees it, with the stress that `stress(y)` gives in the order of components.
template <class Geometry, class Stress> Simulation<Geometry> standing(const Scene& scene, Stress&& stress) {
  Simulation<Geometry> s{.scene = scene,
                         .kernel = Kernel<2>(scene.numerics.smoothing_length * scene.spacing),
                         .particles = make_column<Geometry>(scene),
                         .mirrors = scene_mirrors(scene)};
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i)
    for (int c = 0; c < 4; ++c) p.stress[c][i] = stress(p.position[1][i])[c];
  s.images = find_images(p, s.mirrors, s.kernel.support);
  s.records.motion.resize(p.padded() + s.images.list.size());
  s.records.stress.resize(s.records.motion.size());
  show_motion(p, s.records);
  reflect_motion(s.images, s.mirrors, s.records);
  find_neighbours(p, s.images, s.records, s.kernel.support, s.lists);
  update_gradient(p, s.kernel, s.lists, s.records);
  show_stress(p, scene, s.kernel.h, s.records);
  reflect_stress(s.images, s.mirrors, s.records);
  update_acceleration(p, s.kernel, s.lists, s.records, scene.numerics);
  return s;
}

/// Second moment of the kernel's slope on the lattice; 1 in the continuum; 0.0026 are missing.
double lattice_moment(const Kernel<2>& kernel) {
  double sum = 0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) {
      const double x = i * spacing, y = j * spacing;
      sum -= spacing * spacing * kernel.gradient_factor(std::hypot(x, y)) * x * x;
    }
  return sum;
}

/// Expects the acceleration (0, `vertical`), m/s2, wherever the support is complete: to rounding, and to what
/// the lattice's moment lacks in `vertical` and in the balance of radial and hoop stress.
template <class Geometry> void expect_acceleration(const Simulation<Geometry>& s, double vertical) {
  const auto& p = s.particles;
  const double lacking = std::abs(1 - lattice_moment(s.kernel)) * (1 + 1e-9);
  ASSERT_LT(lacking, 0.005);
  double worst = 0;
  for (int i = 0; i < p.count; ++i) {
    if (p.position[1][i] > height - s.kernel.support) continue;
    const double radial = Geometry::hoop ? std::abs(p.stress[0][i]) / (1500 * p.position[0][i]) : 0;
    const double allowed[2] = {lacking * radial, lacking * vertical},
                 rounding = 1e-12 * 700 / (1500 * spacing);
    for (int a = 0; a < 2; ++a) {
      const double found = p.stress_acceleration[a][i] + p.wall_acceleration[a][i];
      worst = std::max(worst, std::abs(found - (a == 1 ? vertical : 0)) - allowed[a] - rounding);
    }
  }
  EXPECT_LE(worst, 0);
}

template <class Geometry> void expect_no_force_of_uniform_stress(GateMotion gate) {
  const auto stress = [](double) { return std::array{-300.0, -500.0, -300.0, 0.0}; };
  expect_acceleration(standing<Geometry>(column_scene(gate), stress), 0);
}

TEST(Mirrors, UniformStressLeavesNoForceAtAxisFloorAndGate) {
  expect_no_force_of_uniform_stress<PlaneStrain>(GateMotion::fixed);
  expect_no_force_of_uniform_stress<Axisymmetric>(GateMotion::fixed);
}

TEST(Mirrors, AGateThatHasNotMovedYetIsClosed) {
  expect_no_force_of_uniform_stress<PlaneStrain>(GateMotion::lift);
}

TEST(Mirrors, GeostaticStressCarriesTheWeightDownToTheFloor) {
  auto scene = column_scene(GateMotion::fixed);
  scene.gravity = 9.81;
  const auto stress = [](double y) {
    const double vertical = -1500 * 9.81 * (height - y);
    return std::array{0.5 * vertical, vertical, 0.5 * vertical, 0.0};
  };
  expect_acceleration(standing<PlaneStrain>(scene, stress), 9.81);
  expect_acceleration(standing<Axisymmetric>(scene, stress), 9.81);
}

/// One particle with all quantities set, and its images at a corner of floor and gate, or floor and axis.
struct Lone {
  Particles<Axisymmetric> p;
  std::vector<Mirror> mirrors;
  Images images;
  Records<Axisymmetric> records;

  Lone(const Scene& scene, double x, double y) : mirrors(scene_mirrors(scene)) {
    p.resize(1, 0);
    p.position[0][0] = x;
    p.position[1][0] = y;
    p.velocity[0][0] = 3;
    p.velocity[1][0] = 4;
    p.density[0] = 1500;
    p.mass[0] = 0.01;
    for (int c = 0; c < 4; ++c) p.stress[c][0] = -1000.0 * (c + 1);
    images = find_images(p, mirrors, reach);
    records.motion.resize(p.padded() + images.list.size());
    records.stress.resize(records.motion.size());
    show_motion(p, records);
    show_stress(p, scene, 1.5 * spacing, records);
    reflect();
  }
  void reflect() {
    reflect_motion(images, mirrors, records);
    reflect_stress(images, mirrors, records);
  }
  const MotionRecord<2>& motion(int image) const { return records.motion[images.first + image]; }
  const StressRecord<Axisymmetric>& stress(int image) const { return records.stress[images.first + image]; }
};

void expect_at(const MotionRecord<2>& record, double x, double y, double vx, double vy) {
  EXPECT_NEAR(record.position[0], x, 1e-15);
  EXPECT_NEAR(record.position[1], y, 1e-15);
  EXPECT_EQ(record.velocity[0], vx);
  EXPECT_EQ(record.velocity[1], vy);
}

TEST(Mirrors, ACornerHoldsThreeImages) {
  const double x = 0.4 * spacing, y = 0.7 * spacing;
  const Lone lone(column_scene(GateMotion::fixed), x, y);
  ASSERT_EQ(lone.images.list.size(), 3);
  EXPECT_EQ(lone.images.first_wall, lone.images.first + 1)
      << "the axis is no wall, its image under the floor is";
  expect_at(lone.motion(0), -x, y, -3, 4);
  expect_at(lone.motion(1), x, -y, 3, -4);
  expect_at(lone.motion(2), -x, -y, -3, -4);
  for (int image = 0; image < 3; ++image) EXPECT_EQ(lone.motion(image).volume, lone.records.motion[0].volume);

  // Flux is r sigma: r changes sign across the axis, shear at each mirror.
  EXPECT_EQ(lone.stress(0).weight, -x);
  EXPECT_EQ(lone.stress(1).weight, x);
  const double flux[3][4] = {{x * 1000, x * 2000, x * 3000, -x * 4000},
                             {-x * 1000, -x * 2000, -x * 3000, x * 4000},
                             {x * 1000, x * 2000, x * 3000, x * 4000}};
  for (int image = 0; image < 3; ++image)
    for (const int c : {0, 1, 3}) EXPECT_NEAR(lone.stress(image).flux[c], flux[image][c], 1e-12);
  EXPECT_EQ(lone.stress(0).reduced_stress[3], 4000);
  EXPECT_EQ(lone.stress(2).reduced_stress[3], -4000);
}

TEST(Mirrors, BehindTheFloorTheWeightGoesOn) {
  auto scene = column_scene(GateMotion::fixed);
  scene.gravity = 10;
  const double x = 10 * spacing, y = 0.5 * spacing, more = 1500 * 10 * 2 * y;
  const Lone lone(scene, x, y);
  ASSERT_EQ(lone.images.list.size(), 1);
  EXPECT_NEAR(lone.stress(0).flux[1], x * (-2000 - more), 1e-12);
  EXPECT_NEAR(lone.stress(0).flux[0], x * (-1000 - 0.5 * more), 1e-12);
}

TEST(Mirrors, TheGateActsAboveItsEdge) {
  const auto scene = column_scene(GateMotion::lift);
  const double edge = 10 * spacing;
  Lone lone(scene, radius - 0.5 * spacing, edge);
  ASSERT_EQ(lone.images.list.size(), 1);
  expect_at(lone.motion(0), radius + 0.5 * spacing, edge, -3, 4);
  EXPECT_GT(lone.motion(0).volume, 0);

  move_gate(lone.mirrors, scene, (edge + 1e-6) / 1.6); // just above the particle
  lone.reflect();
  EXPECT_EQ(lone.motion(0).volume, 0);
  EXPECT_EQ(lone.stress(0).volume, 0);
  EXPECT_TRUE(find_images(lone.p, lone.mirrors, reach).list.empty());

  lone.p.position[1][0] = edge + 2e-6; // thrown up, inside
  show_motion(lone.p, lone.records);
  lone.reflect();
  EXPECT_GT(lone.motion(0).volume, 0);

  lone.p.position[0][0] = radius + 1e-6; // outside
  show_motion(lone.p, lone.records);
  lone.reflect();
  EXPECT_EQ(lone.motion(0).volume, 0);
}

TEST(Mirrors, ARemovedGateIsNone) {
  const Lone lone(column_scene(GateMotion::remove), radius - 0.5 * spacing, 10 * spacing);
  EXPECT_TRUE(lone.images.list.empty());
}

} // namespace
