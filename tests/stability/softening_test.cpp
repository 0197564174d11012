// SPDX-License-Identifier: BSD-3-Clause
// Softening: dense sand compressed between rough plates under a constant pressure. The strength is the material's; how
// fast it is lost, once strain gathers in a band, goes with the spacing, as the model has no length of its own.
#include "host/engine/metrics.hpp"
#include "tests/stability/confined.hpp"
#include "tests/stability/naive_scheme.hpp"
#include "tests/verification/scenes.hpp"
#include <algorithm>
#include <numeric>

namespace {

using host::PlaneStrain;

struct Response {
  double peak = 0, peak_strain = 0, late = 0; ///< friction angles, degrees; axial strain
  double band = 0;                            ///< share of the particles that hold half of the plastic strain
};

constexpr double pressure = 5e3, width = 0.04, height = 0.08, speed = 0.05; // Pa, m, m, m/s of each plate

Response compress(double spacing) {
  auto scene = tests::column_scene(
      {.geometry = "plane_strain", .material = "SS", .void_ratio = 0.58, .spacing = spacing},
      fmt::format("stability_softening_{}", spacing));
  scene.column = {width, height};
  scene.gravity = 0;
  auto s = host::start_simulation<PlaneStrain>(scene);
  s.scene.symmetric = false;
  s.walls.clear();
  s.surfaces.clear();
  auto& p = s.particles;
  const stability::Places lattice(p);
  for (auto& state : p.state) std::ranges::fill(state, 0.0);
  for (int c = 0; c < 4; ++c) std::ranges::fill(p.stress[c], c < 3 ? -pressure : 0.0);
  update_stress(p, s.scene.material, {1e-12, 1e-12, 1e-12}, s.blocks, stability::Stages(p));
  const auto plate = [&](int i) {
    const double y = lattice.of(p, i)[1];
    return y < 2 * spacing ? 1 : (y > height - 2 * spacing ? -1 : 0);
  };
  Response out;
  constexpr double end = 0.08; // axial strain
  while (2 * speed * s.time / height < end) {
    stability::confined_step(s, pressure, [&](auto& particles, auto& stages) {
      for (int i = 0; i < particles.count; ++i)
        if (const int side = plate(i))
          for (int a = 0; a < 2; ++a) {
            stages.stress_acceleration[a][i] = stages.viscous_acceleration[a][i] = 0;
            particles.velocity[a][i] = a == 1 ? side * speed : 0;
          }
    });
    double sum = 0, volume = 0;
    for (int i = 0; i < p.count; ++i)
      if (!plate(i)) {
        sum -= p.stress[1][i] * p.mass[i] / p.density[i];
        volume += p.mass[i] / p.density[i];
      }
    const double axial = sum / volume, strain = 2 * speed * s.time / height;
    const double angle = std::asin((axial - pressure) / (axial + pressure)) * 180 / std::numbers::pi;
    if (angle > out.peak) {
      out.peak = angle;
      out.peak_strain = strain;
    }
    out.late = angle;
  }
  std::vector<double> plastic;
  for (int i = 0; i < p.count; ++i)
    if (!plate(i)) plastic.push_back(p.state[1][i]);
  std::ranges::sort(plastic, std::greater{});
  const double all = std::reduce(plastic.begin(), plastic.end());
  std::size_t in_band = 0;
  for (double sum = 0; sum < all / 2; ++in_band) sum += plastic[in_band];
  out.band = double(in_band) / double(plastic.size());
  std::printf("spacing %.3g mm: friction angle %.2f deg at %.2f %%, %.2f deg at %.0f %%; half of the plastic "
              "strain in %.3f of "
              "the particles\n",
              1e3 * spacing, out.peak, 100 * out.peak_strain, out.late, 100 * end, out.band);
  return out;
}

TEST(Softening, StrengthIsTheMaterialsBandsAreTheSpacings) {
  const auto coarse = compress(0.005), middle = compress(0.0033333), fine = compress(0.0025);
  for (const auto& r : {coarse, middle}) EXPECT_NEAR(r.peak, fine.peak, 1);
  // A boundary of the model: the narrower the band, the more is lost at the same shortening.
  EXPECT_GT(coarse.late - fine.late, 2);
  EXPECT_GT(coarse.band, middle.band);
  EXPECT_GT(middle.band, fine.band);
}

} // namespace
