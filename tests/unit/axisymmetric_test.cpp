// SPDX-License-Identifier: BSD-3-Clause
// Presets as tests on axisymmetric specimens: which of them there are, and that they hold what the presets hold.
#include "drivers/element/axisymmetric.hpp"
#include <gtest/gtest.h>

using namespace drivers;

namespace {

TEST(Axisymmetric, PresetsOfOneConditionThatAxialStrainDrives) {
  std::vector<std::string_view> names;
  for (const auto& test : axisymmetric_tests()) names.push_back(test.name);
  const std::vector<std::string_view> expected{"oedometric", "triaxial-drained", "triaxial-undrained",
                                               "triaxial-constant-p", "triaxial-constant-volume"};
  EXPECT_EQ(names, expected);
  EXPECT_EQ(find_axisymmetric_test("simple-shear-drained"), nullptr);
}

// The held conditions of a preset, on stresses and strains with 22 = 33, and the one of the axisymmetric test vanish
// together: stress and strain are chosen so that the latter does.
TEST(Axisymmetric, AStateThatMeetsTheConditionMeetsThoseOfThePreset) {
  for (const auto& test : axisymmetric_tests()) {
    SCOPED_TRACE(test.name);
    const auto& held = test.held;
    AxisymmetricTensor stress{3, 0}, strain{0.2, 0};
    if (test.prescribes_strain())
      strain.radial = strain.axial * test.strain_ratio();
    else
      stress.radial = -held.stress.axial * stress.axial / held.stress.radial;
    EXPECT_NEAR(held.at(stress, strain), 0, 1e-15);
    const Vector6 sigma = weights(stress.axial, stress.radial, stress.radial),
                  epsilon = weights(strain.axial, strain.radial, strain.radial);
    for (const auto& condition : find_preset(test.name)->held)
      EXPECT_NEAR(condition.at(sigma, epsilon), 0, 1e-15);
    stress.radial += 1;
    strain.radial += 1;
    EXPECT_GT(held.at(stress, strain), 0.5); // increases with what the search varies
  }
}

TEST(Axisymmetric, RatiosOfStrainIncrements) {
  EXPECT_EQ(find_axisymmetric_test("oedometric")->strain_ratio(), 0);
  EXPECT_EQ(find_axisymmetric_test("triaxial-undrained")->strain_ratio(), -0.5);
  EXPECT_EQ(find_axisymmetric_test("triaxial-drained")->strain_ratio(), -0.25); // Poisson's ratio
  EXPECT_EQ(find_axisymmetric_test("triaxial-constant-p")->strain_ratio(),
            -0.5); // elastic: no change of volume
}

TEST(Axisymmetric, QuantitiesThatATestHolds) {
  const auto holds = [](const char* test, const char* quantity) {
    return find_axisymmetric_test(test)->holds(quantity);
  };
  EXPECT_TRUE(holds("triaxial-drained", "radial_stress"));
  EXPECT_FALSE(holds("triaxial-drained", "mean_stress"));
  EXPECT_TRUE(holds("triaxial-constant-p", "mean_stress"));
  EXPECT_TRUE(holds("triaxial-undrained", "volumetric_strain"));
  EXPECT_TRUE(holds("oedometric", "radial_strain"));
  EXPECT_FALSE(holds("oedometric", "radial_stress"));
}

} // namespace
