// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/load_path.hpp"
#include "drivers/element/presets.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace drivers;

namespace {

Stage stage_of(const std::string& text) {
  const auto document = parse_toml(text, "path.toml");
  const auto stage = read_stage(document, 1, {"p", "q"});
  document.finish();
  return stage;
}

std::string error_of(const std::string& text) {
  try {
    stage_of(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(LoadPath, EveryPresetIsSixIndependentConditionsOnAnElasticMaterial) {
  for (const auto& preset : presets())
    for (const auto& drive : preset.drives) {
      SCOPED_TRACE(preset.name + " " + drive);
      auto text = "control = '" + preset.name + "'\nincrements = 1\n" + drive + " = 0.1\n";
      if (preset.ratio == "intermediate_ratio") text += "intermediate_ratio = 0.5\n";
      if (preset.ratio.ends_with("ratios")) text += preset.ratio + " = [-0.2, 0.3]\n";
      const auto control = control_from(stage_of(text), Vector6::Zero(), Vector6::Zero());
      Matrix6 stiffness = 2 * Matrix6::Identity();
      stiffness.topLeftCorner<3, 3>().array() += 1;
      const Matrix6 system = control.stress * stiffness + control.strain;
      EXPECT_EQ(system.fullPivLu().rank(), 6);
      EXPECT_EQ(control.change[0], 0.1);
    }
}

TEST(LoadPath, StressIsDrivenToItsFinalValueAndStrainByItsChange) {
  const Vector6 stress(50, 20, 20, 0, 0, 0), strain(0.3, 0, 0, 0, 0, 0);
  const auto by_stress = stage_of("control = 'triaxial-drained'\naxial_stress = 80\nincrements = 4");
  EXPECT_DOUBLE_EQ(control_from(by_stress, stress, strain).change[0], 30);
  const auto by_strain = stage_of("control = 'triaxial-drained'\naxial_strain = 0.1\nincrements = 4");
  EXPECT_DOUBLE_EQ(control_from(by_strain, stress, strain).change[0], 0.1);
  EXPECT_DOUBLE_EQ(control_from(by_strain, stress, strain).at_start[0], 0.3);
}

TEST(LoadPath, IncrementsByCountOrBySize) {
  const std::string triaxial = "control = 'triaxial-drained'\n";
  EXPECT_EQ(stage_of(triaxial + "axial_strain = -0.4\nstrain_increment = 1e-5").increments, 40000);
  EXPECT_EQ(stage_of(triaxial + "axial_strain = 0.1\nstrain_increment = 0.03").increments, 4);
  EXPECT_EQ(stage_of(triaxial + "axial_strain = 0.1\nincrements = 7").increments, 7);
}

TEST(LoadPath, PorePressureKeepsTheHeldTotalStress) {
  const auto undrained = stage_of("control = 'triaxial-undrained'\naxial_strain = 0.1\nincrements = 7");
  EXPECT_DOUBLE_EQ(pore_pressure_change(undrained, Vector6(5, -2, -2, 0, 0, 0)), 2);
  const auto drained = stage_of("control = 'triaxial-drained'\naxial_strain = 0.1\nincrements = 7");
  EXPECT_EQ(pore_pressure_change(drained, Vector6(5, -2, -2, 0, 0, 0)), 0);
}

TEST(LoadPath, ErrorsNameTheKey) {
  const std::string triaxial = "control = 'triaxial-drained'\n";
  EXPECT_NE(error_of("control = 'triaxial'\n").find("key 'control': expected one of \"isotropic\""),
            std::string::npos);
  EXPECT_EQ(
      error_of(triaxial + "increments = 1"),
      "path.toml:1: key 'axial_strain': expected one of axial_strain, axial_stress, deviator, found none of "
      "them");
  EXPECT_EQ(
      error_of(triaxial + "axial_strain = 1\naxial_stress = 1\nincrements = 1"),
      "path.toml:3: key 'axial_stress': expected only one of axial_strain, axial_stress, deviator, found "
      "'axial_strain' as well");
  EXPECT_EQ(error_of(triaxial + "axial_strain = 1\nincrements = 0"),
            "path.toml:3: key 'increments': expected an integer from 1 to 1000000000, found 0");
  EXPECT_TRUE(
      error_of(triaxial + "axial_strain = 1\nincrements = 1\nstop = [{quantity = 'r', below = 1}]")
          .starts_with("path.toml:4: key 'stop.quantity': expected one of \"p\", \"q\", \"strain_11\""));
  EXPECT_EQ(error_of(triaxial + "axial_stress = 1\nstrain_increment = 1"),
            "path.toml:1: key 'increments': expected an integer from 1 to 1000000000, found no such key");
  EXPECT_NE(error_of(triaxial + "axial_strain = 1\nincrements = 1\nintermediate_ratio = 0.5").find("unknown"),
            std::string::npos);
}

TEST(LoadPath, MixedControlTakesSixIndependentConditions) {
  const auto text = [](const char* sixth) {
    return std::string(
               "control = 'mixed'\nincrements = 2\ncondition = [{strain = [1,0,0,0,0,0], change = 0.1},"
               "{stress = [0,1,0,0,0,0], final = 7}, {stress = [0,0,1,0,0,0], strain = [0,0,5,0,0,0]},"
               "{strain = [0,0,0,1,0,0]}, {strain = [0,0,0,0,1,0]}, {strain = ") +
           sixth + "}]";
  };
  const auto stage = stage_of(text("[0,0,0,0,0,1]"));
  EXPECT_EQ(stage.conditions[1].value, 7);
  EXPECT_TRUE(stage.conditions[1].is_final);
  EXPECT_EQ(stage.conditions[2].strain[2], 5);
  EXPECT_NE(error_of(text("[0,0,0,0,2,0]")).find("expected six independent conditions"), std::string::npos);
}

} // namespace
