// SPDX-License-Identifier: BSD-3-Clause
// The push of walls taken apart by surfaces adds up to the push of all of them.
#include "host/walls/push.hpp"
#include "tests/verification/walls_fixture.hpp"

namespace {

using namespace tests;
using host::Axisymmetric, host::PlaneStrain, host::ThreeDimensional;

/// Sand thrown against a corner; then, of every particle near walls, the parts against the sum.
template <class Geometry> void expect_parts_add_up(const WallCase& c, const std::string& name) {
  constexpr int D = Geometry::dimension;
  auto s = host::start_simulation<Geometry>(wall_scene(c, name));
  for (int a = 0; a < D; ++a)
    std::fill_n(s.particles.velocity[a].begin(), s.particles.count, a == D - 1 ? -1.0 : 0.5);
  for (int k = 0; k < 60; ++k) host::step(s);
  const host::PairsOfStep<Geometry> pairs{s.kernel, s.lists, s.records, s.images};
  std::vector<host::NearSurface<D>> near;
  for (std::size_t k = 0; k < s.surfaces.size(); ++k)
    if (!s.surfaces[k].is_symmetry()) near.push_back({&s.surfaces[k], int(k), 0, {}, {}});
  double error = 0, size = 0;
  for (int cluster = 0; cluster < s.particles.clusters(); ++cluster) {
    // Records are of the last step, and so must be stress and density of the cluster itself.
    auto sand = s.particles;
    for (int i = cluster * host::lanes; i < std::min((cluster + 1) * host::lanes, sand.count); ++i) {
      for (std::size_t e = 0; e < sand.stress.size(); ++e) sand.stress[e][i] = s.records.stress[i].stress[e];
      sand.density[i] = s.records.stress[i].density;
    }
    const auto forces =
        host::forces_on(sand, s.kernel, s.lists, s.records, host::medium_of(s.scene), cluster);
    for (int l = 0; l < host::lanes && cluster * host::lanes + l < sand.count; ++l) {
      const int i = cluster * host::lanes + l;
      for (auto& n : near) n.push = {};
      const auto by_others = host::separate_push(pairs, i, sand.density[i], near);
      for (int a = 0; a < D; ++a) {
        double sum = by_others[a];
        for (const auto& n : near) sum += n.push[a];
        error = std::max(error, std::abs(sum - forces.wall[a][l]));
        size = std::max(size, std::abs(forces.wall[a][l]));
      }
    }
  }
  std::printf("%s: largest push %.3g m/s2, parts off by %.1e of it\n", name.c_str(), size, error / size);
  EXPECT_GT(size, 10);
  EXPECT_LT(error, 1e-10 * size);
}

const std::string
    base = "[[wall]]\nname = \"base\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]\nfriction = 0.3\n",
    tube =
        "[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\nside = \"inside\"\nradius = 0.05\nfriction = 0.3\n";

TEST(SplitPush, PartsAddUpToThePushOfAllWalls) {
  const std::string column = "radius = 0.05\nheight = 0.03", material = sand("TS", 0.4451);
  expect_parts_add_up<PlaneStrain>(
      {.column = column, .material = material, .walls = base + tube, .spacing = 0.005}, "split_plane");
  expect_parts_add_up<Axisymmetric>({.geometry = "axisymmetric",
                                     .column = column,
                                     .material = material,
                                     .walls = base + tube,
                                     .spacing = 0.005},
                                    "split_rings");
  std::string solid_base = base;
  solid_base.replace(solid_base.find("[0, 0]"), 6, "[0, 0, 0]");
  solid_base.replace(solid_base.find("[0, 1]"), 6, "[0, 0, 1]");
  expect_parts_add_up<ThreeDimensional>({.geometry = "three_dimensional\"\nsector = \"full",
                                         .column = column,
                                         .material = material,
                                         .walls = solid_base + tube,
                                         .spacing = 0.01},
                                        "split_solid");
}

} // namespace
