// SPDX-License-Identifier: BSD-3-Clause
// Walls without slip against a closed form: an elastic layer between two plates that slide past each other. Between
// them the shear stress is even, G times way over distance.
#include "tests/verification/walls_fixture.hpp"

namespace {

using namespace tests;
using host::PlaneStrain, host::ThreeDimensional;

constexpr double half_width = 0.02, height = 0.12, young = 1e6, poisson = 0.2;
constexpr double modulus = young / (2 * (1 + poisson)); // of shear, Pa
constexpr double way = 2e-5, duration = 0.05; // m, s: slow beside the 5 ms of a shear wave to and fro

/// Plates to the left and to the right, one moving down, one up, on a smooth base and, in three dimensions, between
/// smooth sides. The layer is under its own weight, as noise grows in what is sheared alone.
template <class Geometry> WallCase layer(const std::string& friction, double spacing) {
  constexpr bool solid = Geometry::dimension == 3;
  const std::string zero = solid ? "0, 0" : "0";
  const auto plate = [&](const std::string& name, int side) {
    return fmt::format("[[wall]]\nname = \"{}\"\nshape = \"plane\"\npoint = [{}, {}]\nnormal = [{}, {}]\n"
                       "friction = {}\nvelocity = [{}, {}]\nstart = 0\nend = {}\n",
                       name, side * half_width, zero, -side, zero, friction, zero,
                       0.5 * side * way / duration, duration);
  };
  const auto smooth = [](const std::string& name, const std::string& point, const std::string& normal) {
    return fmt::format(
        "[[wall]]\nname = \"{}\"\nshape = \"plane\"\npoint = [{}]\nnormal = [{}]\nfriction = 0\n", name,
        point, normal);
  };
  return {
      .geometry = solid ? "three_dimensional\"\nsector = \"full" : "plane_strain",
      .column = fmt::format("radius = {}\nheight = {}\n{}", half_width, height,
                            solid ? "depth = 0.01" : "symmetric = false"),
      .material = elastic(young, poisson, 1),
      .walls =
          plate("left", -1) + plate("right", 1) + smooth("base", zero + ", 0", zero + ", 1") +
          (solid ? smooth("front", "0, -0.01, 0", "0, 1, 0") + smooth("back", "0, 0.01, 0", "0, -1, 0") : ""),
      .spacing = spacing};
}

struct Shear {
  double stress = 0, strain = 0; ///< Pa and 1, in the middle third of the height
  double slip = 0;               ///< m, largest, of the particles next to the plates
  double rough = 0; ///< m, by how much a particle's displacement is off a straight profile, root mean square
};

template <class Geometry> Shear shear(const std::string& friction, double spacing, const std::string& name) {
  constexpr int D = Geometry::dimension, up = D - 1;
  auto s = host::start_simulation<Geometry>(wall_scene(layer<Geometry>(friction, spacing), name));
  auto& p = s.particles;
  std::vector<double> start(p.count);
  for (int i = 0; i < p.count; ++i) start[p.id[i]] = p.position[up][i];
  run_until(s, duration + 0.02);
  Shear found;
  double weight = 0, squares = 0, products = 0, offs = 0;
  for (int i = 0; i < p.count; ++i) {
    const double x = p.position[0][i], moved = p.position[up][i] - start[p.id[i]];
    if (std::abs(start[p.id[i]] - height / 2) > height / 6) continue;
    if (std::abs(x) > half_width - spacing)
      found.slip = std::max(found.slip, std::abs(moved - (x > 0 ? 0.5 : -0.5) * way));
    weight += 1;
    found.stress += p.stress[host::component<D>(0, up)][i];
    squares += x * x;
    products += x * moved;
    offs += std::pow(moved - x * way / (2 * half_width), 2);
  }
  found.stress /= weight;
  found.strain = products / squares;
  found.rough = std::sqrt(offs / weight);
  return found;
}

constexpr double exact = way / (2 * half_width), coarse = 0.004; // m

void print(const std::string& name, const Shear& found) {
  std::printf("%s: strain %.4f, stress %.4f of the exact; particles off by %.4f, slip by %.1e of the way\n",
              name.c_str(), found.strain / exact, found.stress / (modulus * exact), found.rough / way,
              found.slip / way);
}

template <class Geometry> void expect_sheared(const std::string& name) {
  const auto found = shear<Geometry>("\"no-slip\"", coarse, name);
  print(name, found);
  EXPECT_NEAR(found.strain, exact, 0.05 * exact);
  EXPECT_NEAR(found.stress, modulus * exact, 0.05 * modulus * exact);
  EXPECT_LT(found.rough, 0.1 * way);
  EXPECT_LT(found.slip, 0.01 * way);
}

TEST(NoSlip, PlatesShearALayerInPlaneStrain) {
  expect_sheared<PlaneStrain>("no_slip_plane");
}

TEST(NoSlip, PlatesShearALayerInThreeDimensions) {
  expect_sheared<ThreeDimensional>("no_slip_solid");
}

TEST(NoSlip, SmoothPlatesDoNot) {
  EXPECT_LT(std::abs(shear<PlaneStrain>("0", coarse, "slip").stress), 1e-3 * modulus * way / half_width);
}

TEST(NoSlip,
     MoreParticlesAreNoBetter) { // a boundary: even and odd layers come apart, which strain does not see
  const auto found = shear<PlaneStrain>("\"no-slip\"", coarse / 2, "no_slip_fine");
  print("twice the particles", found);
  EXPECT_NEAR(found.strain, exact, 0.1 * exact);
  EXPECT_NEAR(found.stress, modulus * exact, 0.1 * modulus * exact);
  EXPECT_GT(found.rough, 0.03 * way);
}

TEST(NoSlip,
     FrictionOnImagesThatSlipIsNot) { // the counter-case: a coefficient of 10 on images of a smooth wall
  const auto found = shear<PlaneStrain>("10", coarse, "rough_images");
  print("images of a smooth wall", found);
  EXPECT_GT(found.rough, 0.1 * way);
}

TEST(NoSlipFloor, IsTheWallOfTheSameKind) {
  const WallCase c{.column = "radius = 0.05\nheight = 0.05",
                   .material = sand("TS", 0.6),
                   .walls = "[floor]\nfriction = \"no-slip\"\n[gate]\nmotion = \"remove\"\n",
                   .spacing = 0.005};
  auto s = host::start_simulation<PlaneStrain>(wall_scene(c, "no_slip_floor"));
  run_until(s, 0.15);
  expect_same_if_written("[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\n"
                         "friction = \"no-slip\"\n",
                         c, "no_slip_wall", s);
}

} // namespace
