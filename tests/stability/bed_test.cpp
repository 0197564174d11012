// SPDX-License-Identifier: BSD-3-Clause
// A bed that should stay at rest: for five seconds, from its first moment, up to its surface and walls.
#include "tests/stability/naive_scheme.hpp"
#include "tests/verification/scenes.hpp"

namespace {

using host::PlaneStrain;
using Simulation = host::Simulation<PlaneStrain>;

Simulation bed(const std::string& name) {
  return host::start_simulation<PlaneStrain>(
      tests::column_scene({.geometry = "plane_strain", .spacing = 0.00625, .gate = "motion = \"fixed\""},
                          "stability_bed_" + name));
}

struct Unrest {
  double displacement = 0; ///< largest at the end, spacings
  double kinetic = 0;      ///< largest of all times, initial potential energy
  double stress = 0;       ///< largest error of the vertical stress below the two top layers, relative
  double late = 0;         ///< largest of the last tenth
};

template <class Step> Unrest leave(Simulation s, double duration, Step&& step) {
  Unrest out;
  const stability::Places start(s.particles);
  while (s.time < duration) {
    step(s);
    const double kinetic = host::kinetic_energy(s.particles) / s.initial_potential_energy;
    out.kinetic = std::max(out.kinetic, kinetic);
    if (s.time > 0.9 * duration) out.late = std::max(out.late, kinetic);
  }
  const auto& p = s.particles;
  for (int i = 0; i < p.count; ++i)
    out.displacement = std::max(out.displacement, std::hypot(p.position[0][i] - start.of(p, i)[0],
                                                             p.position[1][i] - start.of(p, i)[1]) /
                                                      s.scene.spacing);
  for (int i = 0; i < p.count; ++i) {
    const double depth = 0.05 - start.of(p, i)[1];
    if (depth > 2 * s.scene.spacing)
      out.stress = std::max(out.stress,
                            std::abs(p.stress[1][i] / (-s.scene.bulk_density * s.scene.gravity * depth) - 1));
  }
  std::printf("after %.3g s: displacement %.3g spacings, vertical stress off by %.2g, kinetic energy %.2g, "
              "at the end %.2g\n",
              s.time, out.displacement, out.stress, out.kinetic, out.late);
  return out;
}

const auto product = [](Simulation& s) { host::step(s); };
const auto naive = [](Simulation& s) { return stability::naive_step(s); };

/// A step with stress smoothed as density is in fluids: all of it, weight and all, at a rate of 0.1 h c.
void smooth_all(Simulation& s) {
  host::step(s);
  auto& p = s.particles;
  stability::Stages stages(p);
  for (int i = 0; i < p.count; ++i)
    for (int c = 0; c < 4; ++c) {
      double rate = 0;
      for (int j = 0; j < p.count; ++j) {
        const double d = std::hypot(p.position[0][i] - p.position[0][j], p.position[1][i] - p.position[1][j]);
        rate += p.mass[j] / p.density[j] * (p.stress[c][i] - p.stress[c][j]) * s.kernel.gradient_factor(d);
      }
      stages.stress_diffusion[c][i] = 0.2 * s.kernel.h * p.wave_speed[i] * rate;
    }
  diffuse(p, s.dt, stages);
}

TEST(Bed, StaysForFiveSeconds) {
  const auto ours = leave(bed("ours"), 5, product);
  const auto other = leave(bed("smoothed"), 0.5, smooth_all);
  const auto textbook = leave(bed("naive"), 0.5, naive);
  EXPECT_LT(ours.displacement, 1e-3);
  EXPECT_LT(ours.stress, 0.02);
  EXPECT_LT(ours.late, ours.kinetic);
  EXPECT_GT(other.displacement, 10 * ours.displacement);
  EXPECT_GT(std::max(other.stress, textbook.stress), 0.05);
}

TEST(Bed, StartsWithoutAShock) {
  const auto ours = leave(bed("start"), 0.05, product);
  auto unstressed = bed("unstressed"); // gravity at once, the stress to carry it not there
  for (auto& component : unstressed.particles.stress) std::ranges::fill(component, 0.0);
  const auto other = leave(std::move(unstressed), 0.05, product);
  EXPECT_LT(ours.kinetic, 1e-6);
  EXPECT_GT(other.kinetic, 1000 * ours.kinetic);
}

/// Largest error of the rate of compression of a bed that is compressed evenly, at its surface and at walls.
TEST(Bed, HasACompleteStrainAtSurfaceAndWalls) {
  const auto find_gradient = [](Simulation& s) {
    host::update_lists(s);
    stability::Stages found(s.particles);
    update_gradient(s.particles, s.kernel, s.lists, s.records, found);
    return found;
  };
  const auto error = [](Simulation s, auto&& step, bool at_surface) {
    const stability::Places start(s.particles);
    for (int i = 0; i < s.particles.count; ++i)
      s.particles.velocity[1][i] = -1e-3 * s.particles.position[1][i];
    const stability::Stages found = step(s);
    const auto& p = s.particles;
    double largest = 0;
    for (int i = 0; i < p.count; ++i)
      if ((start.of(p, i)[1] > 0.05 - 2 * s.scene.spacing) == at_surface)
        largest = std::max(largest, std::abs(found.velocity_gradient[3][i] / -1e-3 - 1));
    return largest;
  };
  std::printf("error of the strain rate: surface, naive %.2g, ours %.2g; else naive %.2g, ours %.2g\n",
              error(bed("a"), naive, true), error(bed("b"), find_gradient, true),
              error(bed("c"), naive, false), error(bed("d"), find_gradient, false));
  EXPECT_LT(error(bed("b"), find_gradient, true), 1e-9);
  EXPECT_LT(error(bed("d"), find_gradient, false), 1e-9);
  EXPECT_GT(error(bed("a"), naive, true), 0.3);
}

} // namespace
