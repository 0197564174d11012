// SPDX-License-Identifier: BSD-3-Clause
// Motion of single particles: free fall, friction, walls that hold, and the account of their work.
#include "host/scheme/geometry.hpp"
#include "host/walls/contact.hpp"
#include "tests/unit/host_fixture.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace host;
using host_test::Stages;

using host_test::spacing;
constexpr double reach = 3 * spacing, g = 9.81, dt = 1e-4;
constexpr double far_reach = 0.1; // m: more than any particle moves in a step here

Scene scene_with(double friction, GateMotion gate = GateMotion::fixed) {
  Scene scene;
  scene.spacing = spacing;
  scene.gravity = g;
  scene.floor.friction = friction;
  scene.gate = {gate, 1.6, 0.05};
  return scene;
}

Particles<PlaneStrain> one_particle(double x, double y, double vx, double vy) {
  Particles<PlaneStrain> p;
  p.resize(1, 0);
  p.position[0][0] = x;
  p.position[1][0] = y;
  p.velocity[0][0] = vx;
  p.velocity[1][0] = vy;
  p.mass[0] = 0.5;
  p.density[0] = 1500;
  return p;
}

/// A step under the accelerations of `stages`, without neighbours, among the walls of a scene as they are at `time`.
template <class Geometry>
Work integrate(Particles<Geometry>& p, const Scene& scene, double dt_before, double dt_now,
               const Stages<Geometry>& stages, double time = 0) {
  auto s = host_test::empty_cloud<Geometry>(0, scene);
  s.particles = p;
  s.dt_before = dt_before;
  s.dt = dt_now;
  s.time = time;
  host_test::place_walls(s, time);
  find_images(p, s.surfaces, far_reach, 0, s.images);
  s.lists.interior.assign(p.clusters(), 0);
  s.lists.total.assign(p.clusters(), 0);
  s.records.motion.resize(p.padded());
  s.records.stress.resize(p.padded());
  const Work work = host_test::integrate(s, stages);
  p = s.particles;
  return work;
}

/// A step of `dt` after one of the same size.
template <class Geometry>
Work advance(Particles<Geometry>& p, const Scene& scene, const Stages<Geometry>& stages) {
  return integrate(p, scene, dt, dt, stages);
}

/// The same without forces.
template <class Geometry> Work advance(Particles<Geometry>& p, const Scene& scene, double time = 0) {
  return integrate(p, scene, dt, dt, Stages<Geometry>(p), time);
}

TEST(Integrate, FreeFallIsTheParabolaForAnyStepSizes) {
  const auto scene = scene_with(0.5, GateMotion::remove);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> step(0.1 * dt, 3 * dt);
  auto p = one_particle(0.02, 1, 0.3, 2);
  Work work;
  double t = 0, before = 0;
  while (t < 0.3) {
    const double now = step(random);
    work.add(integrate(p, scene, before, now, Stages<PlaneStrain>(p)));
    t += now;
    before = now;
    ASSERT_NEAR(p.position[0][0], 0.02 + 0.3 * t, 1e-13);
    ASSERT_NEAR(p.position[1][0], 1 + 2 * t - 0.5 * g * t * t, 1e-13);
    ASSERT_NEAR(p.velocity[1][0], 2 - g * (t - 0.5 * now), 1e-13) << "the velocity of half a step ago";
  }
  EXPECT_EQ(work.total(), 0);
  EXPECT_EQ(work.guarded, 0);
}

Particles<PlaneStrain> on_the_floor(double velocity) {
  return one_particle(0.02, 0.5 * spacing, velocity, 0);
}

/// The forces on it: the floor carries its weight, stress pushes it by `push`, m/s2, along the floor.
Stages<PlaneStrain> floor_forces(double push, double by_floor = g) {
  Stages<PlaneStrain> stages(on_the_floor(0));
  stages.wall_acceleration[1][0] = by_floor;
  stages.stress_acceleration[0][0] = push;
  return stages;
}

TEST(Integrate, ASlidingParticleSlowsDownByFrictionTimesItsWeight) {
  const auto scene = scene_with(0.4);
  for (const double velocity : {0.2, -0.2}) {
    auto p = on_the_floor(velocity);
    const auto stop = int(std::abs(velocity) / (0.4 * g * dt)); // whole steps before it stands
    Work work;
    for (int n = 1; n <= stop + 50; ++n) {
      work.add(advance(p, scene, floor_forces(0)));
      const double expected = n <= stop ? velocity - std::copysign(0.4 * g * n * dt, velocity) : 0;
      ASSERT_NEAR(p.velocity[0][0], expected, 1e-13);
    }
    EXPECT_EQ(p.velocity[0][0], 0) << "stands, and stays";
    EXPECT_EQ(p.position[1][0], 0.5 * spacing);
    EXPECT_NEAR(work.friction, -0.5 * p.mass[0] * velocity * velocity, 1e-15);
    EXPECT_EQ(work.total(), work.friction);
  }
}

TEST(Integrate, AParticleSticksUntilPushedHarderThanFriction) {
  const auto scene = scene_with(0.4);
  auto held = on_the_floor(0), pushed = held;
  for (int n = 0; n < 100; ++n) {
    advance(held, scene, floor_forces(0.39 * g));
    advance(pushed, scene, floor_forces(0.41 * g));
  }
  EXPECT_EQ(held.position[0][0], 0.02);
  EXPECT_NEAR(pushed.velocity[0][0], 0.01 * g * 100 * dt, 1e-13);
}

TEST(Integrate, NoFrictionAboveTheFloorNorWhereItPulls) {
  const auto scene = scene_with(0.4);
  auto high = on_the_floor(0.2), pulled = high;
  high.position[1][0] = reach;
  advance(high, scene, floor_forces(0));
  advance(pulled, scene, floor_forces(0, -g));
  EXPECT_EQ(high.velocity[0][0], 0.2);
  EXPECT_EQ(pulled.velocity[0][0], 0.2);
  EXPECT_DOUBLE_EQ(pulled.velocity[1][0], -g * dt) << "a floor does not pull";
}

TEST(Integrate, AnImpactOnTheFloorTakesTangentialSpeedToo) {
  const auto scene = scene_with(0.4);
  auto p = one_particle(0.02, (contact_gap + 1e-6) * spacing, 3, -2);
  const Work work = advance(p, scene);
  EXPECT_EQ(p.velocity[1][0], 0);
  EXPECT_NEAR(p.velocity[0][0], 3 - 0.4 * (2 + g * dt), 1e-13);
  EXPECT_DOUBLE_EQ(p.position[1][0], contact_gap * spacing);
  EXPECT_EQ(work.guarded, 1);
}

TEST(Integrate, NothingPassesAxisFloorOrGate) {
  const auto scene = scene_with(0.3);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0.001, 0.049);
  std::normal_distribution<double> speed(0, 50); // up to several spacings per step
  Particles<PlaneStrain> p;
  p.resize(1003, 0);
  for (int i = 0; i < p.count; ++i)
    for (auto& x : p.position) x[i] = place(random);
  long guarded = 0;
  for (int n = 0; n < 300; ++n) {
    for (int i = 0; i < p.count; ++i)
      for (auto& v : p.velocity) v[i] = speed(random);
    guarded += advance(p, scene).guarded;
    for (int i = 0; i < p.count; ++i) {
      ASSERT_GE(p.position[0][i], axis_gap * spacing * (1 - 1e-9));
      ASSERT_LE(p.position[0][i], 0.05 - contact_gap * spacing * (1 - 1e-9));
      ASSERT_GE(p.position[1][i], contact_gap * spacing * (1 - 1e-9));
    }
  }
  EXPECT_GT(guarded, 1000);
}

Scene solid_scene(double friction, Sector sector = Sector::quarter) {
  auto scene = scene_with(friction);
  scene.geometry = GeometryKind::three_dimensional;
  scene.sector = sector;
  return scene;
}

TEST(Integrate, NothingPassesTheCylinderOrThePlanesOfSymmetry) {
  const auto scene = solid_scene(0.3);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0.001, 0.03);
  std::normal_distribution<double> speed(0, 50); // up to several spacings per step
  Particles<ThreeDimensional> p;
  p.resize(503, 0);
  for (int i = 0; i < p.count; ++i)
    for (auto& x : p.position) x[i] = place(random);
  long guarded = 0;
  for (int n = 0; n < 300; ++n) {
    for (int i = 0; i < p.count; ++i)
      for (auto& v : p.velocity) v[i] = speed(random);
    guarded += advance(p, scene).guarded;
    for (int i = 0; i < p.count; ++i) {
      // Where a plane meets the cylinder, this draws a particle towards the axis, and nearer to the plane.
      ASSERT_GT(p.position[0][i], 0);
      ASSERT_GT(p.position[1][i], 0);
      ASSERT_GE(p.position[2][i], contact_gap * spacing * (1 - 1e-9));
      ASSERT_LE(std::hypot(p.position[0][i], p.position[1][i]), 0.05 - contact_gap * spacing * (1 - 1e-9));
    }
  }
  EXPECT_GT(guarded, 1000);
}

TEST(Integrate, TheCylinderTakesTheNormalVelocityOnly) {
  const auto scene = solid_scene(0.3, Sector::full);
  Particles<ThreeDimensional> p;
  p.resize(1, 0);
  p.mass[0] = p.density[0] = 1;
  const double angle = 2.2, out[2] = {std::cos(angle), std::sin(angle)},
               r = 0.05 - (contact_gap + 1e-6) * spacing;
  p.position[0][0] = r * out[0];
  p.position[1][0] = r * out[1];
  p.position[2][0] = 0.02;
  for (int a = 0; a < 2; ++a) p.velocity[a][0] = 4 * out[a] + (a == 0 ? -3 * out[1] : 3 * out[0]);
  EXPECT_EQ(advance(p, scene).guarded, 1);
  const double normal = p.velocity[0][0] * out[0] + p.velocity[1][0] * out[1];
  EXPECT_NEAR(normal, 0, 0.03) << "the particle has slid along, and the normal turned by 3 dt / r";
  EXPECT_NEAR(std::hypot(p.velocity[0][0], p.velocity[1][0]), 3, 0.03);
}

TEST(Integrate, FrictionOpposesTheSlidingInAnyDirection) {
  const auto scene = solid_scene(0.4, Sector::full);
  Particles<ThreeDimensional> p;
  p.resize(1, 0);
  p.mass[0] = 0.5;
  p.density[0] = 1500;
  p.position[2][0] = 0.5 * spacing;
  p.velocity[0][0] = 0.12;
  p.velocity[1][0] = -0.16;
  Stages<ThreeDimensional> stages(p);
  stages.wall_acceleration[2][0] = g;          // the floor carries the weight
  const auto stop = int(0.2 / (0.4 * g * dt)); // whole steps before it stands
  Work work;
  for (int n = 1; n <= stop + 50; ++n) {
    work.add(advance(p, scene, stages));
    const double speed = n <= stop ? 0.2 - 0.4 * g * n * dt : 0;
    ASSERT_NEAR(p.velocity[0][0], 0.6 * speed, 1e-13);
    ASSERT_NEAR(p.velocity[1][0], -0.8 * speed, 1e-13);
  }
  EXPECT_NEAR(work.friction, -0.5 * 0.5 * 0.2 * 0.2, 1e-15);
}

TEST(Integrate, WorkClosesTheEnergyWithoutGravity) {
  auto scene = scene_with(0.3);
  scene.gravity = 0;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(0.001, 0.049);
  std::normal_distribution<double> normal;
  Particles<Axisymmetric> p;
  p.resize(205, 0);
  for (int i = 0; i < p.count; ++i) {
    p.mass[i] = 1 + place(random);
    for (int a = 0; a < 2; ++a) {
      p.position[a][i] = place(random);
      p.velocity[a][i] = normal(random);
    }
  }
  Work work;
  Stages<Axisymmetric> stages(p);
  const double before = kinetic_energy(p);
  for (int n = 0; n < 200; ++n) {
    for (auto* kind : {&stages.stress_acceleration, &stages.viscous_acceleration, &stages.wall_acceleration})
      for (auto& a : *kind)
        for (int i = 0; i < p.count; ++i) a[i] = 100 * normal(random);
    work.add(advance(p, scene, stages));
  }
  EXPECT_NEAR(kinetic_energy(p) - before, work.total(), 1e-12 * before);
  EXPECT_LT(work.friction, 0);
  EXPECT_GT(work.guarded, 100);
}

TEST(Integrate, TheGateHoldsAboveItsEdgeOnly) {
  const auto scene = scene_with(0, GateMotion::lift);
  auto above = one_particle(0.0495, 0.021, 30, 0), below = one_particle(0.0495, 0.019, 30, 0),
       outside = one_particle(0.051, 0.021, 30, 0);
  for (auto* p : {&above, &below, &outside}) advance(*p, scene, 0.02 / 1.6);
  EXPECT_DOUBLE_EQ(above.position[0][0], 0.05 - contact_gap * spacing);
  EXPECT_EQ(above.velocity[0][0], 0);
  EXPECT_NEAR(below.position[0][0], 0.0525, 1e-15);
  EXPECT_NEAR(outside.position[0][0], 0.054, 1e-15);
}

TEST(Integrate, EnergiesAreTheTextbooks) {
  const auto p = one_particle(0.1, 0.2, 3, 4);
  EXPECT_DOUBLE_EQ(kinetic_energy(p), 0.5 * 0.5 * 25);
  EXPECT_DOUBLE_EQ(potential_energy(p, g), 0.5 * g * 0.2);
}

} // namespace
