// SPDX-License-Identifier: BSD-3-Clause
// Sand at up to 10 m/s against walls, and walls at 10 m/s against sand: none passes, none keeps away, and the momentum
// that walls take up is what the sand loses.
#include "host/walls/contact.hpp"
#include "tests/verification/walls_fixture.hpp"

namespace {

using namespace tests;
using host::Axisymmetric, host::PlaneStrain, host::ThreeDimensional;

/// Sand in flight: no stress, one velocity.
template <class Geometry> void throw_sand(host::Simulation<Geometry>& s, const host::WallVector& velocity) {
  for (auto& component : s.particles.stress) component.assign(component.size(), 0.0);
  for (int a = 0; a < Geometry::dimension; ++a)
    std::fill_n(s.particles.velocity[a].begin(), s.particles.count, velocity[a]);
  s.steepest = 0;
  if constexpr (Geometry::hoop)
    for (int i = 0; i < s.particles.count; ++i)
      s.steepest = std::max(s.steepest, std::abs(velocity[0]) / s.particles.position[0][i]);
}

/// Nearest approach of any particle to each wall, m, at this moment.
template <class Geometry> std::vector<double> approach(const host::Simulation<Geometry>& s) {
  constexpr int D = Geometry::dimension;
  std::vector<double> nearest(s.walls.size(), host::unbounded);
  std::vector<host::Surface<D>> surfaces;
  host::find_surfaces(0, s.walls, s.scene.geometry, s.time, 0, surfaces);
  for (const auto& surface : surfaces)
    for (int i = 0; i < s.particles.count; ++i) {
      host::Vector<D> x;
      for (int a = 0; a < D; ++a) x[a] = s.particles.position[a][i];
      if (host::beside(surface, x))
        nearest[surface.wall] = std::min(nearest[surface.wall], host::body_distance(surface, x));
    }
  return nearest;
}

/// Small steps, and the recommended ones. Pairs exchange momentum up to the strain of one step, of which the host aims at
/// 0.005 at most: volumes are those before it, densities those after.
struct Steps {
  std::string numerics;
  double most_lost; ///< momentum not accounted for, over that of the walls
};
const Steps small_steps{"step_factor = 0.1", 1e-3}, recommended{"", 5e-3};

/// Throws the sand of a scene; `hit` walls are approached to `within` spacings, none is passed, and what they took up is
/// what the sand lost, up to `most_lost` of it.
template <class Geometry>
void expect_tight_with(double most_lost, const WallCase& c, const std::string& name,
                       const host::WallVector& velocity, double duration, const std::vector<std::string>& hit,
                       double within) {
  auto s = host::start_simulation<Geometry>(wall_scene(c, name));
  throw_sand(s, velocity);
  const auto begin = momentum_of(s.particles);
  const double gap = host::contact_gap * s.scene.spacing, mass = mass_of(s.particles);
  std::vector<double> nearest(s.walls.size(), host::unbounded);
  while (s.time < duration) {
    host::step(s);
    const auto now = approach(s);
    for (std::size_t w = 0; w < now.size(); ++w) {
      nearest[w] = std::min(nearest[w], now[w]);
      ASSERT_GT(now[w], gap * (1 - 1e-3)) << s.walls[w].name << " at " << s.time;
    }
  }
  for (std::size_t w = 0; w < s.walls.size(); ++w)
    if (std::ranges::find(hit, s.walls[w].name) != hit.end()) {
      EXPECT_LT(nearest[w], within * s.scene.spacing) << s.walls[w].name << ": a gap";
    }
  std::printf("%s:", name.c_str());
  for (std::size_t w = 0; w < s.walls.size(); ++w)
    std::printf(" %s %.3f spacings,", s.walls[w].name.c_str(), nearest[w] / s.scene.spacing);
  if (host::planes_of_symmetry(s.scene) == 0) {
    const auto end = momentum_of(s.particles);
    double error = 0, size = 0;
    for (int a = 0; a < Geometry::dimension; ++a) {
      double gained = end[a] - begin[a];
      if (a == Geometry::dimension - 1) gained += mass * g * (s.time - 0.5 * s.dt);
      for (const auto& load : s.loads) {
        gained += load.impulse[a];
        size = std::max(size, std::abs(load.impulse[a]));
      }
      error = std::max(error, std::abs(gained));
    }
    std::printf(" momentum not accounted for %.1e", error / size);
    EXPECT_LT(error, most_lost * size);
  }
  std::printf("\n");
}

/// With small steps and with the recommended ones.
template <class Geometry>
void expect_tight(WallCase c, const std::string& name, const host::WallVector& velocity, double duration,
                  const std::vector<std::string>& hit, double within = 0.5) {
  for (const Steps& steps : {small_steps, recommended}) {
    c.numerics = steps.numerics;
    expect_tight_with<Geometry>(steps.most_lost, c, name, velocity, duration, hit, within);
  }
}

TEST(Tight, PlanesAndBoxesInPlaneStrain) {
  const std::string vessel = "[[wall]]\nname = \"vessel\"\nshape = \"box\"\nside = \"inside\"\nlower = "
                             "[-0.1, 0]\nupper = [0.15, 0.3]\n"
                             "friction = 0.3\n[[wall]]\nname = \"ramp\"\nshape = \"plane\"\npoint = [0.1, "
                             "0]\nnormal = [-1, 1]\nfriction = 0.5\n"
                             "[[wall]]\nname = \"block\"\nshape = \"box\"\nside = \"outside\"\nlower = "
                             "[-0.06, -0.05]\nupper = [-0.01, 0.05]\n"
                             "friction = \"no-slip\"\n";
  expect_tight<PlaneStrain>(
      {.column = "radius = 0.025\nheight = 0.05\nsymmetric = false\nbase = 0.1\ncenter = [-0.02]",
       .material = sand("TS", 0.4451),
       .walls = vessel,
       .spacing = 0.005},
      "tight_plane", {6, -8, 0}, 0.03, {"vessel", "ramp", "block"});
}

TEST(Tight, TubesAndBoxesInAxisymmetry) {
  const std::string base =
      "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\nfriction = 0.3\n";
  const std::string others =
      "[[wall]]\nname = \"post\"\nshape = \"cylinder\"\nside = \"outside\"\nradius = 0.03\nlower = -1\nupper "
      "= 0.04\n"
      "friction = 0.3\n[[wall]]\nname = \"ring\"\nshape = \"box\"\nside = \"outside\"\nlower = [0.07, -1]\n"
      "upper = [0.1, 0.03]\nfriction = 0.3\n[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\nside = "
      "\"inside\"\n"
      "radius = 0.15\nfriction = 0\n";
  WallCase c{.geometry = "axisymmetric",
             .column = "radius = 0.05\nheight = 0.03\nbase = 0.06",
             .material = sand("TS", 0.4451),
             .walls = base + others,
             .spacing = 0.005};
  expect_tight<Axisymmetric>(c, "tight_axisymmetric", {6, -8, 0}, 0.03, {"base", "post", "ring", "tube"});
  const auto thrown = [&](const std::string& walls, const std::string& name) {
    c.walls = walls;
    auto s = host::start_simulation<Axisymmetric>(wall_scene(c, name));
    throw_sand(s, {6, -8, 0});
    run_until(s, 0.03);
    return s;
  };
  expect_same_bits(thrown(base + others, "tight_base_wall"),
                   thrown("[floor]\nfriction = 0.3\n" + others, "tight_floor"));
}

TEST(Tight, AllShapesInThreeDimensions) {
  const std::string walls =
      "[[wall]]\nname = \"slope\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [-0.3, 0.2, 1]\nfriction = "
      "0.3\n"
      "[[wall]]\nname = \"post\"\nshape = \"cylinder\"\nside = \"outside\"\nradius = 0.04\ncenter = [0.05, "
      "0.02]\n"
      "lower = -1\nupper = 0.06\nfriction = 0.3\n"
      "[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\nside = \"inside\"\nradius = 0.15\nfriction = 0\n"
      "[[wall]]\nname = \"block\"\nshape = \"box\"\nside = \"outside\"\nlower = [-0.07, -0.05, -1]\n"
      "upper = [0.0, 0.05, 0.05]\nfriction = 0.3\n";
  expect_tight<ThreeDimensional>({.geometry = "three_dimensional\"\nsector = \"full",
                                  .column = "radius = 0.04\ndepth = 0.04\nheight = 0.03\nbase = 0.1",
                                  .material = sand("TS", 0.4451),
                                  .walls = walls,
                                  .spacing = 0.01},
                                 "tight_solid", {5, 1, -8}, 0.03, {"slope", "post", "tube", "block"});
}

/// Sand without motion is hit by a wall at 10 m/s, thrown by it when the wall stops, and caught by one at rest. A layer
/// hit as a whole is held by the pressure of its images: a particle, half a spacing in size, then keeps a gap of
/// less than another half.
TEST(Tight, WallsThatMoveAtTenMetresASecond) {
  constexpr double within = 1;
  expect_tight<PlaneStrain>(
      {.column = "radius = 0.025\nheight = 0.05\nsymmetric = false\nbase = 0.1",
       .material = sand("TS", 0.4451),
       .walls = "[[wall]]\nname = \"ram\"\nshape = \"box\"\nside = \"outside\"\nlower = [-0.1, 0.02]\n"
                "upper = [-0.04, 0.3]\nfriction = 0.5\ntimes = [0, 0.01, 0.011]\nvelocity_x = [8, 8, 0]\n"
                "velocity_z = [-6, -6, 0]\n[[wall]]\nname = \"stop\"\nshape = \"plane\"\npoint = [0.15, 0]\n"
                "normal = [-1, 0]\nfriction = 0.5\n",
       .spacing = 0.005},
      "tight_ram", {0, 0, 0}, 0.03, {"ram", "stop"}, within);
  expect_tight<Axisymmetric>(
      {.geometry = "axisymmetric",
       .column = "radius = 0.05\nheight = 0.03\nbase = 0.02",
       .material = sand("TS", 0.4451),
       .walls = "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\nfriction = "
                "0.3\ntimes = [0, 0.008, 0.009]\nvelocity_z = [10, 10, 0]\n[[wall]]\nname = \"lid\"\n"
                "shape = \"plane\"\npoint = [0, 0.2]\nnormal = [0, -1]\nfriction = 0.3\n",
       .spacing = 0.005},
      "tight_base", {0, 0, 0}, 0.03, {"base", "lid"}, within);
  expect_tight<ThreeDimensional>(
      {.geometry = "three_dimensional\"\nsector = \"full",
       .column = "radius = 0.04\ndepth = 0.04\nheight = 0.03\nbase = 0.1",
       .material = sand("TS", 0.4451),
       .walls =
           "[[wall]]\nname = \"post\"\nshape = \"cylinder\"\nside = \"outside\"\nradius = 0.04\ncenter = "
           "[-0.1, 0.01]\nlower = -1\nupper = 0.3\nfriction = 0.3\ntimes = [0, 0.012, 0.013]\n"
           "velocity_x = [10, 10, 0]\n[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\n"
           "side = \"inside\"\nradius = 0.2\nfriction = 0\n",
       .spacing = 0.01},
      "tight_post", {0, 0, 0}, 0.03, {"post", "tube"}, within);
}

} // namespace
