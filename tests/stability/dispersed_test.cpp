// SPDX-License-Identifier: BSD-3-Clause
// Particles that leave the sand: thrown up at the front, out of reach of all but a few. Their volumes must not drift, or
// they come down on a floor that throws them up again, for ever.
#include "host/engine/step.hpp"
#include "tests/verification/scenes.hpp"

namespace {

struct Deposit {
  double motion = 0;  ///< kinetic energy over the initial potential energy
  double loosest = 1; ///< least density over the initial one
};

/// A column of Drucker-Prager grains, which is at rest after 0.3 s but for what hops at its front; `limited` as the
/// product does it.
Deposit collapse(double angle, bool limited) {
  const auto scene = tests::column_scene(
      {.material = "drucker_prager_24",
       .void_ratio = 0.8762,
       .spacing = 0.0025,
       .extra =
           fmt::format("kinematics = \"jaumann\"\nproperties = [2e6, 0.2, {}, 0.0, 0.0]\n[initial_stress]\n"
                       "K0 = 0.57",
                       angle)},
      fmt::format("dispersed_{:g}_{}", angle, limited));
  auto s = host::start_simulation<host::Axisymmetric>(scene);
  if (!limited) s.blocks.dispersed_density = 0;
  while (s.time < 0.5) host::step(s);
  const auto& p = s.particles;
  return {host::kinetic_energy(p) / s.initial_potential_energy,
          *std::min_element(p.density.begin(), p.density.begin() + p.count) / scene.bulk_density};
}

TEST(Dispersed, GrainsThatLeaveTheSandComeToRest) {
  int hopping = 0;
  for (const double angle : {23., 24., 25., 26., 27.}) {
    const auto ours = collapse(angle, true), naive = collapse(angle, false);
    std::printf("%.0f degrees: motion %.1e, least density %.2f; naive %.1e, %.2f\n", angle, ours.motion,
                ours.loosest, naive.motion, naive.loosest);
    EXPECT_LT(ours.motion, 1e-6);
    EXPECT_GT(ours.loosest, 0.49);
    hopping += naive.motion > 1e-5 && naive.loosest < 0.25;
  }
  EXPECT_GE(hopping, 2); // of five
}

} // namespace
