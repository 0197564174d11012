// SPDX-License-Identifier: BSD-3-Clause
// Named quantities, cyclic stages, critical state, keys set from outside.
#include "drivers/element/bounds.hpp"
#include "drivers/element/load_path.hpp"
#include <gtest/gtest.h>

using namespace drivers;

namespace {

double stress_of(const char* name, const Vector6& v) {
  return find_linear_quantity(name)->condition().at(v, Vector6::Zero());
}
double strain_of(const char* name, const Vector6& v) {
  return find_linear_quantity(name)->condition().at(Vector6::Zero(), v);
}

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

TEST(ElementWords, RoscoeVariablesAreConjugate) {
  const Vector6 stress = weights(7, 3, 2), axisymmetric = weights(7, 3, 3), strain = weights(0.3, -0.1, 0.2);
  EXPECT_NEAR(stress_of("P", stress) * strain_of("eps_P", strain) +
                  stress_of("Q", stress) * strain_of("eps_Q", strain) +
                  stress_of("Z", stress) * strain_of("eps_Z", strain),
              stress.dot(strain), 1e-15);
  EXPECT_NEAR(stress_of("p", axisymmetric) * strain_of("eps_v", strain) +
                  stress_of("q", axisymmetric) * strain_of("eps_q", strain),
              axisymmetric.dot(strain), 1e-15);
}

TEST(ElementWords, RoscoeVariablesAreTheInvariantsOfAxisymmetricTensors) {
  const Vector6 stress = weights(7, 3, 3), extension = weights(2, 5, 5);
  EXPECT_DOUBLE_EQ(stress_of("p", stress), mean_stress(stress));
  EXPECT_DOUBLE_EQ(stress_of("q", stress), deviatoric_stress(stress));
  EXPECT_DOUBLE_EQ(stress_of("q", extension), -deviatoric_stress(extension));
  EXPECT_DOUBLE_EQ(strain_of("eps_q", stress), deviatoric_strain(stress));
  EXPECT_NEAR(std::hypot(stress_of("P", stress), stress_of("Q", stress)), stress.norm(), 1e-14);
  EXPECT_DOUBLE_EQ(strain_of("shear_strain", Vector6::Unit(3)), 2);
}

TEST(ElementWords, ConditionsMayBeWrittenInNames) {
  const auto stage =
      stage_of("control = 'axisymmetric'\nincrements = 2\n"
               "condition = [{eps_q = 1, change = 0.3}, {q = 1, p = -3, stress = [0,0,0,0,0,0]}]");
  EXPECT_TRUE(stage.conditions[0].strain.isApprox(weights(2. / 3, -1. / 3, -1. / 3)));
  EXPECT_TRUE(stage.conditions[1].stress.isApprox(weights(0, -1.5, -1.5)));
  EXPECT_EQ(stage.conditions[2].stress, weights(0, 1, -1));
  EXPECT_EQ(stage.conditions[5].strain, Vector6::Unit(5).eval());
  EXPECT_EQ(error_of("control = 'principal'\nincrements = 2\ncondition = [{p = 1}, {q = 1}]"),
            "path.toml:3: key 'condition': expected 3 tables [[stage.condition]], found 2");
  EXPECT_NE(error_of("control = 'axisymmetric'\nincrements = 2\ncondition = [{p = 1}, {P = 1}]")
                .find("expected six independent conditions, found dependent ones"),
            std::string::npos);
  EXPECT_NE(error_of("control = 'axisymmetric'\nincrements = 2\ncondition = [{p = 1}, {epsq = 1}]")
                .find("expected a known key such as 'eps_"),
            std::string::npos);
}

TEST(ElementWords, CyclicStagesAreDrivenByTheirIncrement) {
  const std::string text = "control = 'triaxial-undrained'\nstrain_increment = 1e-4\n[cyclic]\ncycles = 3\n"
                           "limits = [{quantity = 'deviator', lower = -1, upper = 2}]\n";
  const auto stage = stage_of(text);
  ASSERT_TRUE(stage.cycling);
  EXPECT_EQ(stage.conditions[0].strain, Vector6::Unit(0).eval());
  EXPECT_EQ(stage.cycling->increment, 1e-4);
  EXPECT_TRUE(stage.cycling->upwards);
  EXPECT_EQ(stage.cycling->strain->name, "axial_strain");
  EXPECT_EQ(error_of(text + "drive = 'axial_stress'"),
            "path.toml:1: key 'stress_increment': expected a number above 0, found no such key");
  EXPECT_NE(error_of("axial_strain = 0.1\n" + text).find("unknown"), std::string::npos);
  EXPECT_EQ(error_of("control = 'triaxial-drained'\nstrain_increment = 1\n[cyclic]\ncycles = 3\n"
                     "limits = [{quantity = 'p', lower = 2, upper = 2}]\n"),
            "path.toml:5: key 'cyclic.limits.upper': expected a number above 'lower', found 2.0");
  EXPECT_NE(error_of("control = 'strain'\nstrain = [1,0,0,0,0,0]\n[cyclic]\ncycles = 3\n"
                     "limits = [{quantity = 'p', lower = 1, upper = 2}]\n")
                .find("expected another control with 'cyclic' or 'replay', found \"strain\""),
            std::string::npos);
}

TEST(ElementWords, PorePressureRatioIsThatOfTheHeldStress) {
  const auto stage = stage_of("control = 'triaxial-undrained'\naxial_strain = 0.1\nincrements = 7");
  EXPECT_DOUBLE_EQ(pore_pressure_ratio(stage, weights(30, 20, 20), 15), 0.75);
  const auto drained = stage_of("control = 'triaxial-drained'\naxial_strain = 0.1\nincrements = 7");
  EXPECT_EQ(pore_pressure_ratio(drained, weights(30, 20, 20), 15), 0);
}

constexpr CriticalState sand{24, 0.76, 0.04, 0.3, 101325, 1};

TEST(ElementWords, CriticalStateInCompressionAndExtension) {
  const double sine = std::sin(24 * M_PI / 180);
  EXPECT_NEAR(sand.stress_ratio(-30), 6 * sine / (3 - sine), 1e-14);
  EXPECT_NEAR(sand.stress_ratio(30), 6 * sine / (3 + sine), 1e-14);
  EXPECT_NEAR(sand.void_ratio(101325), 0.72, 1e-14);
}

TEST(ElementWords, CriticalNeedsStressRatioVoidRatioAndConstantVolume) {
  const double p = 101325, q = sand.stress_ratio(-30) * p, e0 = sand.void_ratio(p);
  ElementRow before, now;
  now.point.strain = weights(0.02, -0.01, -0.01);
  now.point.stress = weights(p + 2 * q / 3, p - q / 3, p - q / 3);
  EXPECT_TRUE(is_critical(sand, e0, 0.01, before, now));
  EXPECT_FALSE(is_critical(sand, e0 + 0.02, 0.01, before, now));
  auto moving = now;
  moving.point.strain = weights(0.02, -0.01, -0.009);
  EXPECT_FALSE(is_critical(sand, e0, 0.01, before, moving));
  auto below = now;
  below.point.stress = weights(p + 0.6 * q, p - 0.3 * q, p - 0.3 * q);
  EXPECT_FALSE(is_critical(sand, e0, 0.01, before, below));
  EXPECT_FALSE(is_critical(sand, e0, 0.01, before, ElementRow{}));
}

TEST(ElementWords, SettingsReplaceAndAddKeys) {
  const std::string text = "a = 1\n[t]\nb = 2\n[[s]]\nc = 3\n[[s]]\nc = 4\n";
  const auto read = [&](const Words& settings) { return parse_toml(text, "x.toml", ".", settings); };
  EXPECT_EQ(read({"a=5"}).number("a"), 5);
  EXPECT_EQ(read({"t.b=-1e3"}).table("t").number("b"), -1e3);
  EXPECT_EQ(read({"s.2.c=7"}).tables("s")[1].number("c"), 7);
  EXPECT_EQ(read({"t.file=some.toml"}).table("t").text("file"), "some.toml");
  EXPECT_EQ(read({"u.x=[1, 2]"}).table("u").numbers("x").size(), 2u);
  const auto error = [&](const Words& settings) {
    try {
      read(settings).number("a", {0, 4});
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error({"a=5"}),
            "x.toml (as set by the command): key 'a': expected a number from 0 to 4, found 5");
  EXPECT_EQ(error({"s.3.c=7"}), "--set s.3.c=7: expected TABLE.KEY=VALUE of the file, found no table '3'");
  EXPECT_EQ(error({"a.b=7"}), "--set a.b=7: expected TABLE.KEY=VALUE of the file, found no table 'a'");
  EXPECT_EQ(error({"a"}), "--set a: expected TABLE.KEY=VALUE of the file, found no KEY=VALUE");
}

} // namespace
