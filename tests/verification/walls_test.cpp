// SPDX-License-Identifier: BSD-3-Clause
// Walls against closed forms: a block on an incline, loads at rest and in a rough tube, momentum, tightness, motion.
#include "tests/verification/walls_fixture.hpp"

namespace {

using namespace tests;
using host::Axisymmetric, host::PlaneStrain, host::ThreeDimensional;

/// A block of 16 by 5 particles on a slope: its acceleration down the slope from 0.1 s on, mean of 0.4 s.
double slide(double angle, double friction, const std::string& name) {
  const double a = angle * std::numbers::pi / 180;
  auto s = host::start_simulation<PlaneStrain>(wall_scene(
      {.column = fmt::format("radius = 0.08\nheight = 0.05\nsymmetric = false\nbase = 1.0\ntilt = {}", -angle),
       .material = elastic(2e5, 0.2, 0.25),
       .walls = fmt::format("[[wall]]\nname = \"slope\"\nshape = \"plane\"\npoint = [0, 1.0]\nnormal = [{}, {}]\n"
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
  for (const auto& [angle, friction] : {std::pair{30.0, 0.2}, {30.0, 0.0}, {45.0, 0.6}}) {
    const double a = angle * std::numbers::pi / 180;
    const double wanted = g * (std::sin(a) - friction * std::cos(a));
    const double found = slide(angle, friction, fmt::format("slide_{}_{}", angle, friction));
    EXPECT_NEAR(found, wanted, 0.01 * wanted);
    std::printf("slope %g deg, friction %g: %.4f m/s2, exact %.4f (%.2f %%)\n", angle, friction, found, wanted,
                100 * (found / wanted - 1));
  }
}

TEST(Incline, ABlockSticksBelowTheAngleOfFriction) {
  const double found = slide(20, 0.5, "stick");
  std::printf("stick %.5f\n", found);
  EXPECT_NEAR(found, 0, 0.01 * g);
}

template <class Geometry> void press(const WallCase& c, const std::string& name, double duration) {
  auto s = host::start_simulation<Geometry>(wall_scene(c, name));
  double mass = mass_of(s.particles);
  for (double t = 0; t < duration; t += duration / 4) {
    std::printf("%s t=%.3f E=%.3g guarded %ld:", name.c_str(), s.time, host::kinetic_energy(s.particles) / (mass * g * 0.1), s.work.guarded);
    host::Simulation<Geometry>& r = s;
    const auto old = r.loads;
    const double start = r.time;
    run_until(r, start + duration / 4);
    for (std::size_t w = 0; w < r.loads.size(); ++w)
      std::printf("  %s n %.4f z %.4f", r.walls[w].name.c_str(), (r.loads[w].normal - old[w].normal) / (r.time - start),
                  (r.loads[w].impulse[Geometry::dimension - 1] - old[w].impulse[Geometry::dimension - 1]) / (r.time - start));
    std::printf("  weight %.4f\n", mass * g);
  }
  double sx = 0, sz = 0, base = 0, top = 0;
  for (int i = 0; i < s.particles.count; ++i) {
    sx -= s.particles.stress[0][i] * s.particles.mass[i] / s.particles.density[i] / 0.1;
    sz -= s.particles.stress[1][i] * s.particles.mass[i] / s.particles.density[i] / 0.1;
    if (std::abs(s.particles.position[0][i] - 0.05) < 0.005) std::printf(" z %.4f xx %.4f zz %.4f\n", s.particles.position[1][i], s.particles.stress[0][i] / (0.8182 * 1500 * g * (0.2 - s.particles.position[1][i])), s.particles.stress[1][i] / (1500 * g * (0.2 - s.particles.position[1][i])));
  }
  std::printf("mean xx %.4f zz %.4f\n", sx, sz); (void)base; (void)top;
}

TEST(Hydrostatic, X) {
  const std::string half = "radius = 0.1\nheight = 0.2\n", mat = elastic(1e5, 0.45, 0.8182);
  const std::string box = "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\nfriction = 0\n"
    "[[wall]]\nname = \"side\"\nshape = \"plane\"\npoint = [0.1, 0]\nnormal = [-1, 0]\nfriction = 0\n";
  std::printf("side exact %.4f\n", 0.8182 * 1500 * g * 0.04 / 2);
  press<PlaneStrain>({.column = half, .material = mat, .walls = box}, "hp", 0.1);
  if (0) press<PlaneStrain>({.column = half, .material = mat, .walls = "[floor]\nfriction = 0\n[gate]\nmotion = \"fixed\"\n"}, "hm", 0.4);
  if (0) press<PlaneStrain>({.column = half, .material = mat, .walls = "[[wall]]\nname = \"box\"\nshape = \"box\"\nside = \"inside\"\nlower = [-0.1, 0]\nupper = [0.1, 9]\nfriction = 0\n"}, "hb", 0.4);
  const std::string cyl = "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\nfriction = 0\n"
    "[[wall]]\nname = \"side\"\nshape = \"cylinder\"\nradius = 0.1\nside = \"inside\"\nfriction = 0\n";
  std::printf("side exact %.4f\n", 0.8182 * 1500 * g * 0.04 / 2 * 2 * std::numbers::pi * 0.1);
  press<Axisymmetric>({.geometry = "axisymmetric", .column = half, .material = mat, .walls = cyl}, "ha", 0.1);
}

} // namespace
