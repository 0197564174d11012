// SPDX-License-Identifier: BSD-3-Clause
// Walls against closed forms: a block on an incline, loads at rest and in a rough tube, momentum, tightness, motion.
#include "tests/verification/walls_fixture.hpp"
#include <omp.h>

namespace {

using namespace tests;
using host::Axisymmetric, host::PlaneStrain, host::ThreeDimensional;

/// A block of 16 by 5 particles on a slope: its acceleration down the slope from 0.1 s on, mean of 0.4 s.
double slide(double angle, double friction, const std::string& name) {
  const double a = angle * std::numbers::pi / 180;
  auto s = host::start_simulation<PlaneStrain>(wall_scene(
      {.column =
           fmt::format("radius = 0.08\nheight = 0.05\nsymmetric = false\nbase = 1.0\ntilt = {}", -angle),
       .material = elastic(2e5, 0.2, 0.25),
       .walls =
           fmt::format("[[wall]]\nname = \"slope\"\nshape = \"plane\"\npoint = [0, 1.0]\nnormal = [{}, {}]\n"
                       "friction = {}\n",
                       std::sin(a), std::cos(a), friction)},
      name));
  const double mass = mass_of(s.particles);
  const auto speed = [&] {
    const auto m = momentum_of(s.particles);
    return (m[0] * std::cos(a) - m[1] * std::sin(a)) / mass;
  };
  run_until(s, 0.1);
  const double start = s.time, before = speed();
  run_until(s, start + 0.4);
  return (speed() - before) / (s.time - start);
}

TEST(Incline, ABlockSlidesAsCoulombSays) {
  for (const auto& [angle, friction] : {std::pair{30.0, 0.2}, {30.0, 0.0}, {45.0, 0.5}}) {
    const double a = angle * std::numbers::pi / 180;
    const double wanted = g * (std::sin(a) - friction * std::cos(a));
    const double found = slide(angle, friction, fmt::format("slide_{}_{}", angle, friction));
    EXPECT_NEAR(found, wanted, 0.01 * wanted);
    std::printf("slope %g deg, friction %g: %.4f m/s2, exact %.4f (%.2f %%)\n", angle, friction, found,
                wanted, 100 * (found / wanted - 1));
  }
}

TEST(Incline, ABlockSticksBelowTheAngleOfFriction) {
  const double found = slide(20, 0.5, "stick");
  std::printf("slope 20 deg, friction 0.5: %.5f m/s2, exact 0\n", found);
  EXPECT_NEAR(found, 0, 0.01 * g);
}

TEST(Incline, ABlockOnTheFloorSlowsDownAsCoulombSays) {
  constexpr double friction = 0.3, speed = 1;
  const WallCase c{.column = "radius = 0.08\nheight = 0.05\nsymmetric = false",
                   .material = elastic(2e5, 0.2, 0.25)};
  const std::string rest = "[[wall]]\nname = \"far\"\nshape = \"plane\"\npoint = [5, 0]\nnormal = [-1, 0]\n"
                           "friction = 0\n";
  const auto slide_on = [&](const std::string& walls, const std::string& name) {
    auto with_walls = c;
    with_walls.walls = walls + rest;
    auto s = host::start_simulation<PlaneStrain>(wall_scene(with_walls, name));
    std::fill_n(s.particles.velocity[0].begin(), s.particles.count, speed);
    run_until(s, 0.1);
    return s;
  };
  auto s = slide_on(fmt::format("[floor]\nfriction = {}\n", friction), "slide_floor");
  const auto t = slide_on(fmt::format("[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\n"
                                      "normal = [0, 1]\nfriction = {}\n",
                                      friction),
                          "slide_base");
  expect_same_bits(s, t);
  const double mass = mass_of(s.particles), start = s.time, before = momentum_of(s.particles)[0] / mass;
  run_until(s, start + 0.1);
  const double found = (before - momentum_of(s.particles)[0] / mass) / (s.time - start);
  std::printf("level floor, friction 0.3: slows down by %.4f m/s2, exact %.4f\n", found, friction * g);
  EXPECT_NEAR(found, friction * g, 0.01 * friction * g);
}

/// Walls of a vessel in each geometry, smooth.
const std::string smooth_base =
    "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n"
    "friction = 0\n";
std::string smooth_tube(const std::string& radius) {
  return "[[wall]]\nname = \"side\"\nshape = \"cylinder\"\nside = \"inside\"\nfriction = 0\nradius = " +
         radius + "\n";
}

const std::string smooth_floor = "[floor]\nfriction = 0\n", closed_gate = "[gate]\nmotion = \"fixed\"\n";

/// Loads on base (first wall) and side (second) against weight and K0 rho g h^2 / 2 on `width` of side; the same numbers
/// with the walls in their `short_form`.
template <class Geometry>
void expect_hydrostatic(const WallCase& c, const std::string& short_form, const std::string& name,
                        double width, double settle = 0.05) {
  auto s = host::start_simulation<Geometry>(wall_scene(c, name));
  run_until(s, settle);
  const auto before = s.loads;
  const double start = s.time;
  run_until(s, start + 0.05);
  const auto load = [&](std::size_t wall, auto part) {
    return (part(s.loads[wall]) - part(before[wall])) / (s.time - start);
  };
  const auto normal = [](const host::WallLoad& l) { return l.normal; };
  double all = 0;
  for (std::size_t w = 0; w < s.walls.size(); ++w)
    all -= load(w, [](const host::WallLoad& l) { return l.impulse[Geometry::dimension - 1]; });
  const double weight = mass_of(s.particles) * g, height = s.scene.column.height;
  const double side = s.scene.earth_pressure_ratio * s.scene.bulk_density * g * height * height / 2 * width;
  const double gap = gap_above(s, 0);
  std::printf("%s: vertical load / weight %.5f, base alone %.5f, side / (K0 rho g h^2 / 2) %.5f, widest gap "
              "%.3f spacings\n",
              name.c_str(), all / weight, load(0, normal) / weight, load(1, normal) / side, gap);
  EXPECT_LT(gap, 0.5);
  EXPECT_NEAR(all, weight, 0.01 * weight);
  EXPECT_NEAR(load(0, normal), weight, 0.01 * weight);
  EXPECT_NEAR(load(1, normal), side, 0.01 * side);
  expect_same_if_written(short_form, c, name + "_short", s);
}

TEST(Hydrostatic, LoadsOfAPlaneLayer) {
  expect_hydrostatic<PlaneStrain>({.column = "radius = 0.1\nheight = 0.2",
                                   .material = elastic(1e5, 0.45, 0.45 / 0.55),
                                   .walls = smooth_base + smooth_tube("0.1")},
                                  smooth_floor + closed_gate, "hydrostatic_elastic", 1);
}

TEST(Hydrostatic, LoadsOfSandInATube) {
  expect_hydrostatic<Axisymmetric>({.geometry = "axisymmetric",
                                    .column = "radius = 0.05\nheight = 0.05",
                                    .material = sand("TS", 0.4451),
                                    .walls = smooth_base + smooth_tube("0.05"),
                                    .spacing = 0.0025},
                                   smooth_floor + closed_gate, "hydrostatic_tube",
                                   2 * std::numbers::pi * 0.05);
}

TEST(Hydrostatic, LoadsOfSandInABox) {
  const std::string base = "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0, 0]\n"
                           "normal = [0, 0, 1]\nfriction = 0\n";
  const std::string box =
      "[[wall]]\nname = \"box\"\nshape = \"box\"\nside = \"inside\"\nlower = [-0.06, -0.05, -1]\n"
      "upper = [0.06, 0.05, 1]\nfriction = 0\n";
  expect_hydrostatic<ThreeDimensional>({.geometry = "three_dimensional\"\nsector = \"quarter",
                                        .column = "radius = 0.06\ndepth = 0.05\nheight = 0.1",
                                        .material = sand("SS", 0.58),
                                        .walls = base + box,
                                        .spacing = 0.005},
                                       smooth_floor + box, "hydrostatic_box", 0.06 + 0.05, 0.02);
}

/// Mean vertical stress of all particles, Pa, weighted by volume; compression positive.
double mean_vertical(const host::Particles<Axisymmetric>& p) {
  double sum = 0, volume = 0;
  for (int i = 0; i < p.count; ++i) {
    const double v = p.mass[i] / p.density[i];
    sum -= p.stress[1][i] * v;
    volume += v;
  }
  return sum / volume;
}

TEST(Janssen, ARoughTubeCarriesTheSand) {
  // The tube is raised by 1.5 mm, so that the sand slides down in it and its friction is mobilised.
  constexpr double radius = 0.02, height = 0.12, friction = 0.4;
  const std::string tube =
      "[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\nside = \"inside\"\nradius = 0.02\n"
      "friction = 0.4\nvelocity = [0, 0.015]\nstart = 0\nend = 0.1\n";
  const WallCase c{.geometry = "axisymmetric",
                   .column = "radius = 0.02\nheight = 0.12",
                   .material = sand("SS", 0.7),
                   .walls = smooth_base + tube,
                   .spacing = 0.0025};
  auto s = host::start_simulation<Axisymmetric>(wall_scene(c, "janssen"));
  run_until(s, 0.06);
  const auto before = s.loads;
  const double start = s.time;
  double vertical = 0;
  int samples = 0;
  while (s.time < start + 0.04) {
    host::step(s);
    vertical += mean_vertical(s.particles);
    ++samples;
  }
  vertical /= samples;
  const double time = s.time - start, weight = mass_of(s.particles) * g;
  const double base = (s.loads[0].normal - before[0].normal) / time;
  const double side = (s.loads[1].normal - before[1].normal) / time;
  const double carried = -(s.loads[1].impulse[1] - before[1].impulse[1]) / time;
  const double ratio = side / (2 * std::numbers::pi * radius * height) / vertical;
  const double length = radius / (2 * carried / side * ratio);
  const double janssen = weight * length / height * (1 - std::exp(-height / length));
  std::printf(
      "base / weight %.4f, side friction / weight %.4f, friction mobilised %.4f of %.2f, wall stress ratio "
      "%.4f, Janssen %.4f (deviation %.2f %%)\n",
      base / weight, carried / weight, carried / side, friction, ratio, janssen / weight,
      100 * (base / janssen - 1));
  EXPECT_NEAR(base + carried, weight, 0.02 * weight);
  EXPECT_LT(carried / side, 1.001 * friction);
  EXPECT_GT(carried / side, 0.9 * friction) << "the sand slides nearly everywhere";
  EXPECT_LT(base, 0.6 * weight);
  EXPECT_NEAR(base, janssen, 0.05 * janssen);
  expect_same_if_written(smooth_floor + tube, c, "janssen_short", s);
}

TEST(Moving, APistonLiftsTheSand) {
  // From rest to 0.1 m/s and back within 0.2 s: up by 10 mm, with the push that the acceleration needs.
  auto s = host::start_simulation<PlaneStrain>(wall_scene(
      {.column = "radius = 0.05\nheight = 0.05",
       .material = sand("TS", 0.4451),
       .walls = smooth_base + "times = [0, 0.1, 0.2]\nvelocity_z = [0, 0.1, 0]\n" + smooth_tube("0.05"),
       .spacing = 0.005},
      "piston"));
  const auto height = [&] { return host::potential_energy(s.particles, 1) / mass_of(s.particles); };
  const double before = height(), mass = mass_of(s.particles);
  run_until(s, 0.1);
  const double up = s.loads[0].normal / s.time / (mass * g), speed = momentum_of(s.particles)[1] / mass;
  run_until(s, 0.25);
  std::printf(
      "piston: push %.4f of the weight (exact %.4f), speed %.4f m/s, lifted by %.3f mm, work %.4f of m g h\n",
      up, 1 + 1 / g, speed, 1e3 * (height() - before), s.loads[0].work / (mass * g * 0.01));
  const double gap = gap_above(s, 0.01);
  std::printf("widest gap above the piston, which has come to rest: %.3f spacings\n", gap);
  EXPECT_LT(gap, 0.5);
  EXPECT_NEAR(up, 1 + 1 / g, 0.01);
  EXPECT_NEAR(speed, 0.1, 0.003);
  EXPECT_NEAR(height() - before, 0.01, 1e-4);
  EXPECT_NEAR(s.loads[0].work, mass * g * 0.01, 0.02 * mass * g * 0.01);
}

TEST(Moving, ABoxCarriesTheSandAlong) {
  auto s = host::start_simulation<PlaneStrain>(
      wall_scene({.column = "radius = 0.05\nheight = 0.05\nsymmetric = false\nbase = 0.0",
                  .material = sand("TS", 0.4451),
                  .walls = "[[wall]]\nname = \"box\"\nshape = \"box\"\nside = \"inside\"\nlower = [-0.05, "
                           "0]\nupper = [0.05, 1]\n"
                           "friction = 0.5\ntimes = [0, 0.1, 0.2, 0.3]\nvelocity_x = [0, 0.3, 0.3, 0]\n",
                  .spacing = 0.005},
                 "carried"));
  const double mass = mass_of(s.particles);
  const auto centre = [&] {
    double sum = 0;
    for (int i = 0; i < s.particles.count; ++i) sum += s.particles.mass[i] * s.particles.position[0][i];
    return sum / mass;
  };
  const double start = centre();
  run_until(s, 0.2);
  const double speed = momentum_of(s.particles)[0] / mass;
  run_until(s, 0.4);
  const double shift = centre() - start;
  std::printf("box: speed %.4f of 0.3 m/s, carried by %.2f of 60 mm, at rest %.2g m/s\n", speed, 1e3 * shift,
              momentum_of(s.particles)[0] / mass);
  EXPECT_NEAR(speed, 0.3, 0.01);
  EXPECT_NEAR(shift, 0.06, 2e-3);
  EXPECT_NEAR(momentum_of(s.particles)[0] / mass, 0, 5e-3);
}

/// The same collapse with [floor] and [gate] and with walls of the list.
template <class Geometry> void expect_tube_is_gate(WallCase c, const std::string& name) {
  const bool solid = Geometry::dimension == 3;
  const std::string zero = solid ? "0, 0" : "0";
  c.column = "radius = 0.05\nheight = 0.05";
  c.material = sand("TS", 0.4451);
  c.walls = "[floor]\nfriction = 0.5\n[gate]\nmotion = \"lift\"\nspeed = 1.6\n";
  auto s = host::start_simulation<Geometry>(wall_scene(c, name + "_gate"));
  run_until(s, solid ? 0.04 : 0.15);
  const auto tube = fmt::format(
      "[[wall]]\nname = \"ground\"\nshape = \"plane\"\npoint = [{0}, 0]\nnormal = [{0}, 1]\nfriction = 0.5\n"
      "[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\nside = \"inside\"\nradius = 0.05\nlower = 0\n"
      "friction = 0\nvelocity = [{0}, 1.6]\n",
      zero);
  expect_same_if_written(tube, c, name + "_tube", s);
}

TEST(Moving, ALiftedTubeIsTheGate) {
  expect_tube_is_gate<PlaneStrain>({.spacing = 0.005}, "collapse_plane");
  expect_tube_is_gate<Axisymmetric>({.geometry = "axisymmetric", .spacing = 0.005}, "collapse_rings");
  expect_tube_is_gate<ThreeDimensional>(
      {.geometry = "three_dimensional\"\nsector = \"quarter", .spacing = 0.007}, "collapse_solid");
}

/// A wall that no particle comes near to changes nothing, whether it is at rest or moves, first or last.
template <class Geometry> void expect_idle(WallCase c, const std::string& name) {
  const std::string zero = Geometry::dimension == 3 ? "0, 0" : "0";
  c.column = "radius = 0.05\nheight = 0.05";
  c.material = sand("TS", 0.4451);
  c.walls = "[floor]\nfriction = 0.5\n[gate]\nmotion = \"lift\"\nspeed = 1.6\n";
  auto s = host::start_simulation<Geometry>(wall_scene(c, name));
  run_until(s, Geometry::dimension == 3 ? 0.04 : 0.15);
  const auto ceiling = [&](const std::string& more) {
    return fmt::format(
               "[[wall]]\nname = \"ceiling\"\nshape = \"plane\"\npoint = [{0}, 10]\nnormal = [{0}, -1]\n"
               "friction = 0.5\n",
               zero) +
           more;
  };
  expect_same_if_written(c.walls + ceiling(""), c, name + "_ceiling", s);
  expect_same_if_written(c.walls + ceiling(fmt::format("velocity = [{}, -5]\n", zero)), c, name + "_falling",
                         s);
  const auto post = fmt::format(
      "[[wall]]\nname = \"post\"\nshape = \"cylinder\"\nside = \"outside\"\nradius = 0.1\n"
      "{}lower = 8\nupper = 9\nfriction = 0.5\n",
      Geometry::hoop ? "" : fmt::format("center = [{}]\n", Geometry::dimension == 3 ? "3, 3" : "3"));
  expect_same_if_written(c.walls + post, c, name + "_post", s);
}

TEST(Idle, WallsOutOfReachChangeNothing) {
  expect_idle<PlaneStrain>({.spacing = 0.005}, "idle_plane");
  expect_idle<Axisymmetric>({.geometry = "axisymmetric", .spacing = 0.005}, "idle_rings");
  expect_idle<ThreeDimensional>({.geometry = "three_dimensional\"\nsector = \"quarter", .spacing = 0.007},
                                "idle_solid");
}

/// What a wall that hits sand puts in is its force times its own motion; the guards of a run know it.
TEST(Moving, WallsThatHitSandAreNoEnergyFromNowhere) {
  for (const double speed : {1., 10.}) {
    auto scene = wall_scene(
        {.geometry = "axisymmetric",
         .column = "radius = 0.05\nheight = 0.03\nbase = 0.02",
         .material = sand("TS", 0.4451),
         .walls = fmt::format(
             "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\nfriction "
             "= 0.3\ntimes = [0, 0.03, 0.031]\nvelocity_z = [{0}, {0}, 0]\n",
             speed),
         .spacing = 0.005,
         .end_time = 0.06},
        "hit");
    scene.sample_interval = 0.001;
    omp_set_num_threads(1);
    const auto summary = drivers::run_scene(scene, {.quiet = true});
    std::printf("base at %g m/s: energy closed to %.1e\n", speed, value_of(summary, "energy_imbalance"));
    EXPECT_LT(value_of(summary, "work_viscosity"), 0);
    EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
  }
}

/// Sand in flight shows no wave and stiffens all at once where it lands: a step that knows only of waves is too large.
TEST(Impact, IsSoundAtTheRecommendedStep) {
  for (const double speed : {2., 10.}) {
    const double fall = speed * speed / (2 * g);
    auto scene = wall_scene(
        {.column = fmt::format("radius = 0.025\nheight = 0.05\nsymmetric = false\nbase = {}", fall),
         .material = sand("TS", 0.4451),
         .walls = "[[wall]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0.0, 0.0]\nnormal = [0.0, 1.0]\n"
                  "friction = 0.3",
         .spacing = 0.005,
         .end_time = speed / g + 0.3},
        "impact");
    scene.sample_interval = 0.001; // guards look at every sample: none may pass over the impact
    omp_set_num_threads(1);
    const auto summary = drivers::run_scene(scene, {.quiet = true});
    std::printf("%g m/s: energy closed to %.1e; work of pairs %.2f, walls %.2f, viscosity %.2f\n", speed,
                value_of(summary, "energy_imbalance"), value_of(summary, "work_stress"),
                value_of(summary, "work_wall"), value_of(summary, "work_viscosity"));
    EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
    EXPECT_LT(value_of(summary, "work_stress"), 0);
    EXPECT_LT(value_of(summary, "work_wall"), 0);
    EXPECT_LT(value_of(summary, "work_viscosity"), 0);
  }
}

/// A scene of data/scenes, run as a user would with `settings`: nothing is gained or lost.
void expect_energy_closed(const std::string& name, const std::vector<std::string>& settings) {
  auto scene = drivers::read_scene(fmt::format("{}/data/scenes/{}.toml", SIMSAND_SOURCE_DIR, name), settings);
  scene.output_folder = fresh_folder("shipped_" + name);
  omp_set_num_threads(1);
  const auto summary = drivers::run_scene(scene, {.quiet = true});
  std::printf("%s: energy closed to %.1e, kinetic at the end %.3f\n", name.c_str(),
              value_of(summary, "energy_imbalance"), value_of(summary, "kinetic_energy"));
  EXPECT_LT(value_of(summary, "energy_imbalance"), 0.005);
  EXPECT_LT(value_of(summary, "work_viscosity"), 0);
  EXPECT_LT(value_of(summary, "work_stress"), 0);
}

TEST(ShippedScenes, CloseTheirEnergy) {
  expect_energy_closed("chute", {"scene.spacing=0.01", "end.time=0.8"});
  // The plate is as thin as the reach of particles at 5 mm.
  expect_energy_closed("box", {"end.time=0.2"});
}

} // namespace
