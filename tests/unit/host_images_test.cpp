// SPDX-License-Identifier: BSD-3-Clause
// Images behind axis, floor and gate: where they stand, what they carry, and that a column in equilibrium
// does not notice that it ends there.
#include "host/bodies/initial_particles.hpp"
#include "host/scheme/geometry.hpp"
#include "host/walls/sight.hpp"
#include "tests/unit/host_fixture.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <map>

namespace {

using namespace host;

using host_test::spacing;
constexpr double radius = 20 * spacing, height = 24 * spacing, reach = 3 * spacing; // m

Scene column_scene(GateMotion gate) {
  Scene scene;
  scene.spacing = spacing;
  scene.column = {radius, height};
  scene.bulk_density = 1500;
  scene.earth_pressure_ratio = 0.5;
  scene.gate = {gate, 1.6, radius};
  return scene;
}

template <class Geometry> using Stages = host_test::Stages<Geometry>;

/// Velocity gradients and forces.
template <class Geometry> Stages<Geometry> find_forces(Simulation<Geometry>& s) {
  Stages<Geometry> stages(s.particles);
  update_gradient(s.particles, s.kernel, s.lists, s.records, stages);
  write_stress_records(s.particles, s.scene, s.kernel.h, stages, s.records);
  reflect_stress(s.images, s.surfaces, medium_of(s.scene), s.records);
  update_acceleration(s.particles, s.kernel, s.lists, s.records, s.scene, stages);
  return stages;
}

/// A column at rest as a step sees it, with the stress that `stress(y)` gives in the order of components.
template <class Geometry, class Stress> Simulation<Geometry> standing(const Scene& scene, Stress&& stress) {
  Simulation<Geometry> s{.scene = scene,
                         .kernel = Kernel<2>(scene.numerics.smoothing_length * scene.spacing),
                         .particles = initial_particles<Geometry>(scene)};
  host_test::place_walls(s);
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i)
    for (int c = 0; c < 4; ++c) p.stress[c][i] = stress(p.position[1][i])[c];
  find_images(p, s.surfaces, s.kernel.support, 0, s.images);
  s.records.motion.resize(p.padded() + s.images.list.size());
  s.records.stress.resize(s.records.motion.size());
  host_test::find_lists(s, s.kernel.support);
  return s;
}

/// Images and lists as a step makes them, with what each particle sees of images in shells.
template <class Geometry> void list_with_sight(Simulation<Geometry>& s) {
  auto& p = s.particles;
  find_images(p, s.surfaces, s.kernel.support, 0, s.images);
  s.records.motion.resize(p.padded() + s.images.list.size());
  s.records.stress.resize(s.records.motion.size());
  host_test::show(s);
  find_neighbours(p, s.images, s.records, s.kernel.support, s.outer_lists,
                  find_screened_clusters(p, s.surfaces, s.images, s.kernel.support, 0.0));
  prune(p, s.records, s.kernel.support, s.outer_lists, s.lists);
  find_sight(p, s.surfaces, s.images, s.records, s.lists);
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

constexpr double single_rounding = 5.96e-8; // relative, of one operation: the kernel's

/// Expects the acceleration (0, `vertical`), m/s2, wherever the support is complete: to rounding, and to what
/// the lattice's moment lacks in `vertical` and in the balance of radial and hoop stress.
template <class Geometry> void expect_acceleration(Simulation<Geometry> s, double vertical) {
  const auto& p = s.particles;
  const auto stages = find_forces(s);
  const double lacking = std::abs(1 - lattice_moment(s.kernel)) * (1 + 1e-9);
  ASSERT_LT(lacking, 0.005);
  double worst = 0;
  for (int i = 0; i < p.count; ++i) {
    if (p.position[1][i] > height - s.kernel.support) continue;
    const double radial = Geometry::hoop ? std::abs(p.stress[0][i]) / (1500 * p.position[0][i]) : 0;
    const double allowed[2] = {lacking * radial, lacking * vertical},
                 rounding = 2 * single_rounding * 700 / (1500 * spacing);
    for (int a = 0; a < 2; ++a) {
      const double found = stages.stress_acceleration[a][i] + stages.wall_acceleration[a][i];
      worst = std::max(worst, std::abs(found - (a == 1 ? vertical : 0)) - allowed[a] - rounding);
    }
  }
  EXPECT_LE(worst, 0);
}

template <class Geometry> void expect_no_force_of_uniform_stress(GateMotion gate) {
  const auto stress = [](double) { return std::array{-300.0, -500.0, -300.0, 0.0}; };
  expect_acceleration(standing<Geometry>(column_scene(gate), stress), 0);
}

TEST(Images, UniformStressLeavesNoForceAtAxisFloorAndGate) {
  expect_no_force_of_uniform_stress<PlaneStrain>(GateMotion::fixed);
  expect_no_force_of_uniform_stress<Axisymmetric>(GateMotion::fixed);
}

TEST(Images, AGateThatHasNotMovedYetIsClosed) {
  expect_no_force_of_uniform_stress<PlaneStrain>(GateMotion::lift);
}

TEST(Images, GeostaticStressCarriesTheWeightDownToTheFloor) {
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
  Scene scene;
  Particles<Axisymmetric> p;
  std::vector<Surface<2>> surfaces;
  Images images;
  Records<Axisymmetric> records;

  Lone(const Scene& of, double x, double y) : scene(of) {
    p.resize(1, 0);
    p.position[0][0] = x;
    p.position[1][0] = y;
    p.velocity[0][0] = 3;
    p.velocity[1][0] = 4;
    p.density[0] = 1500;
    p.mass[0] = 0.01;
    for (int c = 0; c < 4; ++c) p.stress[c][0] = -1000.0 * (c + 1);
    place_walls(0);
    list_images();
    records.motion.resize(p.padded() + images.list.size());
    records.stress.resize(records.motion.size());
    show_motion(p, records);
    write_stress_records(p, scene, 1.5 * spacing, Stages<Axisymmetric>(p), records);
    reflect();
  }
  void place_walls(double time) {
    find_surfaces(planes_of_symmetry(scene), all_walls(scene), scene.geometry, time, 0, surfaces);
  }
  void list_images() { find_images(p, surfaces, reach, 0, images); }
  void reflect() {
    reflect_motion(images, surfaces, records);
    reflect_stress(images, surfaces, medium_of(scene), records);
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

TEST(Images, ACornerHoldsThreeImages) {
  const double x = 0.4 * spacing, y = 0.7 * spacing;
  const Lone lone(column_scene(GateMotion::fixed), x, y);
  ASSERT_EQ(lone.images.list.size(), 3);
  EXPECT_EQ(lone.images.first_wall, lone.images.first + 1)
      << "the axis is no wall, its image under the floor is";
  expect_at(lone.motion(0), -x, y, -3, 4);
  expect_at(lone.motion(1), x, -y, 3, -4);
  expect_at(lone.motion(2), -x, -y, -3, -4);
  for (int image = 0; image < 3; ++image) EXPECT_EQ(lone.motion(image).volume, lone.records.motion[0].volume);

  const double shear[3] = {4000, 4000, -4000}; // changes its sign at each mirror
  for (int image = 0; image < 3; ++image) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(lone.stress(image).stress[c], -1000.0 * (c + 1));
    EXPECT_EQ(lone.stress(image).stress[3], shear[image]);
  }
}

TEST(Images, BehindTheFloorTheWeightGoesOn) {
  auto scene = column_scene(GateMotion::fixed);
  scene.gravity = 10;
  const double x = 10 * spacing, y = 0.5 * spacing, more = 1500 * 10 * 2 * y;
  const Lone lone(scene, x, y);
  ASSERT_EQ(lone.images.list.size(), 1);
  EXPECT_NEAR(lone.stress(0).stress[1], -2000 - more, 1e-12);
  EXPECT_NEAR(lone.stress(0).stress[0], -1000 - 0.5 * more, 1e-12);
}

TEST(Images, TheGateReflectsAboveItsEdge) {
  const auto scene = column_scene(GateMotion::lift);
  const double edge = 10 * spacing;
  Lone lone(scene, radius - 0.5 * spacing, edge);
  ASSERT_EQ(lone.images.list.size(), 1);
  expect_at(lone.motion(0), radius + 0.5 * spacing, edge, -3, 4);
  EXPECT_GT(lone.motion(0).volume, 0);

  lone.place_walls((edge + 1e-6) / 1.6); // just above the particle
  lone.reflect();
  EXPECT_EQ(lone.motion(0).volume, 0);

  lone.p.position[1][0] = edge + 2e-6; // thrown up, inside
  show_motion(lone.p, lone.records);
  lone.reflect();
  EXPECT_GT(lone.motion(0).volume, 0);

  lone.p.position[0][0] = radius + 1e-6; // outside
  show_motion(lone.p, lone.records);
  lone.reflect();
  EXPECT_EQ(lone.motion(0).volume, 0);

  lone.place_walls((edge + 2 * reach) / 1.6); // gone
  lone.list_images();
  EXPECT_TRUE(lone.images.list.empty());
}

/// A particle inside of the gate, 0.5 spacings above its edge, and one at (`x`, `y`) spacings from radius and edge: what
/// its image adds to the velocity gradient and the acceleration of the other.
double action_of_image(double x, double y) {
  auto scene = column_scene(GateMotion::lift);
  scene.geometry = GeometryKind::plane_strain;
  const double edge = 10 * spacing;
  auto s = host_test::empty_cloud<PlaneStrain>(2, scene);
  auto& p = s.particles;
  host_test::put(p, 0, {radius - 0.5 * spacing, edge + 0.5 * spacing});
  host_test::put(p, 1, {radius + x * spacing, edge + y * spacing});
  p.velocity[0][0] = 1;
  for (int c = 0; c < 3; ++c) p.stress[c][0] = -1000;
  host_test::place_walls(s, edge / 1.6);
  list_with_sight(s);
  return std::abs(find_forces(s).wall_acceleration[0][1]);
}

TEST(Images, InAShellAreSeenThroughItOnly) {
  EXPECT_GT(action_of_image(-0.5, 1.5), 10) << "behind the gate";
  EXPECT_GT(action_of_image(-0.5, -0.4), 10) << "below the edge, which the line to the image passes above";
  EXPECT_EQ(action_of_image(-0.5, -0.6), 0) << "the line passes below the edge";
  EXPECT_EQ(action_of_image(0.5, -0.5), 0) << "passed under the gate";
  EXPECT_EQ(action_of_image(0.5, 1.5), 0) << "on the other side";
}

TEST(Images, OfSandThatHasPassedUnderTheGateAreNone) {
  for (const double height : {9., 11.}) {
    const Lone lone(column_scene(GateMotion::lift), radius + 0.5 * spacing, height * spacing);
    for (std::size_t k = 0; k < lone.images.list.size(); ++k) EXPECT_EQ(lone.motion(int(k)).volume, 0);
  }
}

/// A particle of a three-dimensional column and its image in the cylindrical gate.
TEST(Images, ACylinderReflectsInItsTangentPlane) {
  auto scene = column_scene(GateMotion::fixed);
  scene.geometry = GeometryKind::three_dimensional;
  Particles<ThreeDimensional> p;
  p.resize(1, 0);
  Stages<ThreeDimensional> stages(p);
  const double r = radius - 0.7 * spacing, angle = 0.6;
  const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0), velocity(3, -4, 5);
  const Eigen::Matrix3d reflection = Eigen::Matrix3d::Identity() - 2 * normal * normal.transpose();
  Eigen::Matrix3d stress, gradient;
  stress << -1, 0.4, 0.5, 0.4, -2, 0.6, 0.5, 0.6, -3;
  gradient << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  for (int a = 0; a < 3; ++a) {
    p.position[a][0] = a < 2 ? r * normal[a] : 10 * spacing;
    p.velocity[a][0] = velocity[a];
    for (int b = 0; b < 3; ++b) {
      p.stress[component<3>(a, b)][0] = stress(a, b);
      stages.velocity_gradient[3 * a + b][0] = gradient(a, b);
    }
  }
  p.density[0] = 1500;
  p.mass[0] = 1500 * std::pow(spacing, 3);
  std::vector<Surface<3>> surfaces;
  find_surfaces(0, all_walls(scene), scene.geometry, 0, 0, surfaces);
  Images images;
  find_images(p, surfaces, reach, 0, images);
  ASSERT_EQ(images.list.size(), 1);
  EXPECT_EQ(images.first_wall, images.first);
  Records<ThreeDimensional> records;
  records.motion.resize(p.padded() + 1);
  records.stress.resize(p.padded() + 1);
  show_motion(p, records);
  write_stress_records(p, scene, 1.5 * spacing, stages, records);
  reflect_motion(images, surfaces, records);
  reflect_stress(images, surfaces, medium_of(scene), records);
  const auto& motion = records.motion[images.first];
  const auto& image = records.stress[images.first];
  const Eigen::Vector3d reflected = reflection * velocity;
  const Eigen::Matrix3d turned = reflection * stress * reflection,
                        turned_gradient = reflection * gradient * reflection;
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(motion.position[a], a < 2 ? (2 * radius - r) * normal[a] : 10 * spacing, 1e-15);
    EXPECT_NEAR(motion.velocity[a], reflected[a], 1e-14);
    for (int b = a; b < 3; ++b) {
      const double both = turned_gradient(a, b) + (a == b ? 0 : turned_gradient(b, a));
      EXPECT_NEAR(image.stress[component<3>(a, b)], turned(a, b), 1e-14);
      EXPECT_NEAR(image.strain_rate[component<3>(a, b)], both, 4e-7 * gradient.norm());
    }
  }
  EXPECT_NEAR(motion.volume, std::pow(spacing, 3) * (2 * radius - r) / r, 1e-20);
}

/// A column in a flow and a stress that are symmetric about the axis.
Simulation<ThreeDimensional> flowing(Sector sector) {
  auto scene = column_scene(GateMotion::lift);
  scene.geometry = GeometryKind::three_dimensional;
  scene.sector = sector;
  scene.gravity = 9.81;
  scene.column = {8 * spacing, 9 * spacing};
  scene.gate.radius = scene.column.radius;
  Simulation<ThreeDimensional> s{.scene = scene,
                                 .kernel = Kernel<3>(1.5 * spacing),
                                 .particles = initial_particles<ThreeDimensional>(scene)};
  host_test::place_walls(s, 3.2 * spacing / scene.gate.speed);
  auto& p = s.particles;
  for (int i = 0; i < p.count; ++i) {
    const double x = p.position[0][i], y = p.position[1][i], z = p.position[2][i], r = std::hypot(x, y);
    const double outwards = 20 * r * std::cos(300 * r + 200 * z);
    const Eigen::Vector3d e(x / r, y / r, 0), up(0, 0, 1);
    const Eigen::Matrix3d stress = -400 * std::cos(200 * z) * e * e.transpose() -
                                   250 * Eigen::Matrix3d::Identity() -
                                   6e3 * r * (e * up.transpose() + up * e.transpose());
    for (int a = 0; a < 3; ++a) {
      p.velocity[a][i] = outwards * e[a] - (a == 2 ? 3 * z : 0);
      for (int b = a; b < 3; ++b) p.stress[component<3>(a, b)][i] = stress(a, b);
    }
    p.wave_speed[i] = 30;
  }
  sort_particles(p, spacing);
  list_with_sight(s);
  return s;
}

TEST(Images, AParticleOfASectorSeesWhatItSeesInTheWhole) {
  auto whole = flowing(Sector::full);
  const auto& w = whole.particles;
  const auto in_whole = find_forces(whole);
  std::map<std::array<long, 3>, int> at;
  const auto place = [](const Particles<ThreeDimensional>& p, int i) {
    return std::array{std::lround(1e7 * p.position[0][i]), std::lround(1e7 * p.position[1][i]),
                      std::lround(1e7 * p.position[2][i])};
  };
  for (int i = 0; i < w.count; ++i) at[place(w, i)] = i;
  for (const Sector sector : {Sector::half, Sector::quarter}) {
    auto part = flowing(sector);
    const auto& p = part.particles;
    const auto in_part = find_forces(part);
    EXPECT_EQ(p.count * (sector == Sector::half ? 2 : 4), w.count);
    for (int i = 0; i < p.count; ++i) {
      ASSERT_TRUE(at.contains(place(p, i)));
      const int j = at[place(p, i)];
      for (int e = 0; e < 9; ++e)
        EXPECT_NEAR(in_part.velocity_gradient[e][i], in_whole.velocity_gradient[e][j], 1e-9);
      for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(in_part.stress_acceleration[a][i], in_whole.stress_acceleration[a][j], 1e-9);
        EXPECT_NEAR(in_part.viscous_acceleration[a][i], in_whole.viscous_acceleration[a][j], 1e-9);
        EXPECT_NEAR(in_part.wall_acceleration[a][i], in_whole.wall_acceleration[a][j], 1e-9);
      }
      for (int c = 0; c < 6; ++c) // a rate of some 1e5 Pa/s
        EXPECT_NEAR(in_part.stress_diffusion[c][i], in_whole.stress_diffusion[c][j], 1e-7);
    }
  }
}

TEST(Images, ARemovedGateIsNone) {
  const Lone lone(column_scene(GateMotion::remove), radius - 0.5 * spacing, 10 * spacing);
  EXPECT_TRUE(lone.images.list.empty());
}

} // namespace
