// SPDX-License-Identifier: BSD-3-Clause
// VUMATs in Fortran, compiled as a user does it, in the element driver and in the SPH host: closed forms and
// what an audit of the inputs finds.
#include "tests/verification/vumat_program.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace {

using namespace tests;

constexpr double young = 2e6, poisson = 0.25, shear_modulus = young / (2 * (1 + poisson));

using Table = std::map<std::string, std::vector<double>>;

/// The CSV table of an element test, by column; one whole failure if there is none.
Table table(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::istringstream lines(outcome.out);
  std::string line, cell;
  std::vector<std::string> names;
  Table columns;
  std::getline(lines, line);
  for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    for (const auto& name : names)
      if (std::getline(row, cell, ',')) columns[name].push_back(std::stod(cell));
  }
  return columns;
}

std::string stage(const std::string& control, const std::string& rest) {
  return fmt::format("[[stage]]\ncontrol = \"{}\"\n{}\n", control, rest);
}

const std::string elastic = material("elastic", "[2e6, 0.25]", 1),
                  j2 = material("j2", "[2e6, 0.25, 2e3, 1e5]", 2),
                  audit = material("audit", "[2e6, 0.25, 1500.0]", 14);

TEST(FortranElastic, UniaxialCompression) {
  auto t = table(run_path(elastic, stage("triaxial-drained", "axial_strain = 0.3\nincrements = 30"), 1e3));
  const auto n = t["step"].size();
  ASSERT_EQ(n, 31);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(t["stress_11_Pa"][i], 1e3 + young * t["strain_11"][i], 1e-2);
    EXPECT_NEAR(t["strain_22"][i], -poisson * t["strain_11"][i], 1e-9);
    EXPECT_EQ(t["state_1"][i], double(i)) << "accepted increments";
  }
}

TEST(FortranElastic, StartsFromTheInitialState) {
  const auto started = material("elastic", "[2e6, 0.25]", 1, "initial_state = [7]");
  auto t = table(run_path(started, stage("triaxial-drained", "axial_strain = 0.3\nincrements = 30"), 1e3));
  ASSERT_EQ(t["state_1"].size(), 31);
  for (std::size_t i = 0; i < 31; ++i) EXPECT_EQ(t["state_1"][i], 7 + double(i)) << "accepted increments";
  EXPECT_EQ(run_scene(elastic).status, 0);
  const auto from_zero = last("state_1");
  EXPECT_EQ(run_scene(started).status, 0);
  const auto from_seven = last("state_1");
  ASSERT_EQ(from_seven.size(), from_zero.size());
  for (std::size_t i = 0; i < from_zero.size(); ++i) EXPECT_EQ(from_seven[i], 7 + from_zero[i]);
}

TEST(FortranElastic, SimpleShearWithRotation) {
  // The closed form of Johnson and Bammann (1984); compression positive.
  auto t = table(run_path(
      elastic, stage("deformation-gradient",
                     "gradient = [1, 4, 0, 0, 1, 0, 0, 0, 1]\nincrements = 2000\noutput_every = 100")));
  const auto n = t["step"].size();
  ASSERT_EQ(n, 21);
  for (std::size_t i = 1; i < n; ++i) {
    const double g = 4.0 * t["step"][i] / 2000, b = std::atan(g / 2), l = std::log(std::cos(b));
    const double normal =
        4 * shear_modulus * (std::cos(2 * b) * l + b * std::sin(2 * b) - std::pow(std::sin(b), 2));
    const double tangential =
        2 * shear_modulus * std::cos(2 * b) * (2 * b - 2 * std::tan(2 * b) * l - std::tan(b));
    EXPECT_NEAR(t["stress_11_Pa"][i], -normal, 1e-6 * shear_modulus);
    EXPECT_NEAR(t["stress_22_Pa"][i], normal, 1e-6 * shear_modulus);
    EXPECT_NEAR(t["stress_12_Pa"][i], -tangential, 1e-6 * shear_modulus);
    EXPECT_NEAR(t["volumetric_strain"][i], 0, 1e-12);
  }
  // The same by its velocity gradient, in three other planes at once only the axes differ.
  auto other = table(run_path(
      elastic,
      stage("deformation-gradient",
            "velocity_gradient = [0, 0, 0, 0, 0, 4, 0, 0, 0]\nincrements = 2000\noutput_every = 2000")));
  EXPECT_NEAR(other["stress_23_Pa"].back(), t["stress_12_Pa"].back(), 1e-4);
  EXPECT_NEAR(other["stress_22_Pa"].back(), t["stress_11_Pa"].back(), 1e-4);
  EXPECT_NEAR(other["stress_11_Pa"].back(), 0, 1e-4);
}

TEST(FortranElastic, ARigidTurnTurnsStress) {
  const double quarter = std::acos(-1.0) / 2;
  auto t = table(run_path(
      elastic, stage("deformation-gradient", "gradient = [0.999, 0, 0, 0, 1, 0, 0, 0, 1]\nincrements = 1") +
                   stage("deformation-gradient",
                         fmt::format("velocity_gradient = [0, 0, {0}, 0, 0, 0, -{0}, 0, 0]\nincrements = 3",
                                     quarter))));
  EXPECT_NEAR(t["stress_33_Pa"].back(), t["stress_11_Pa"][1], 1e-8);
  EXPECT_NEAR(t["stress_11_Pa"].back(), t["stress_33_Pa"][1], 1e-8);
  EXPECT_GT(t["stress_11_Pa"][1], 2 * t["stress_33_Pa"][1]);
}

TEST(FortranElastic, MotionsThatCannotBeFollowedAreRefused) {
  const auto refuses = [](const std::string& stages, const std::string& part) {
    const auto outcome = run_path(elastic, stages);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  const auto motion = [](const std::string& rest) {
    return stage("deformation-gradient", rest + "\nincrements = 10");
  };
  refuses(motion("gradient = [-1, 0, 0, 0, 1, 0, 0, 0, 1]"),
          "path.toml:12: key 'stage.gradient': expected a deformation gradient of positive determinant");
  refuses(motion("gradient = [-1, 0, 0, 0, -1, 0, 0, 0, 1]"),
          "path.toml:12: the straight line to the deformation gradient passes through a determinant of 0");
  refuses(motion("gradient = [1, 0, 0, 0, 1, 0, 0, 0]"), "path.toml:12: key 'stage.gradient': expected");
  refuses(motion("velocity_gradient = [0, 0, 0, 0, 0, 0, 0, 0, 0]\ngradient = [1, 0, 0, 0, 1, 0, 0, 0, 1]"),
          "expected only one of gradient, velocity_gradient");
  refuses(
      motion("velocity_gradient = [0, 1, 0, 0, 0, 0, 0, 0, 0]") + stage("strain", "strain = [0, 0, 0, 0, 0, "
                                                                                  "0]\nincrements = 1"),
      "key 'stage.control': expected either all stages or none by \"deformation-gradient\", found 'strain'");
}

TEST(FortranJ2, UniaxialWithHardeningAndBack) {
  const double yield = 2e3, hardening = 1e5;
  auto t = table(run_path(j2,
                          stage("triaxial-drained", "axial_strain = 0.02\nincrements = 40") +
                              stage("triaxial-drained", "axial_strain = -0.01\nincrements = 20"),
                          1));
  const auto n = t["step"].size();
  ASSERT_EQ(n, 61);
  // Up: elastic, then on the line of slope E H / (E + H). Down: elastic until the same yield stress reversed.
  const auto up = [&](double e) {
    return std::min(young * e, (young * hardening * e + yield * young) / (young + hardening));
  };
  const double top = up(0.02), turn = 0.02 - 2 * top / young;
  for (std::size_t i = 1; i < n; ++i) {
    const double e = t["strain_11"][i], slope = young * hardening / (young + hardening);
    const double expected = i <= 40 ? up(e) : e > turn ? top - young * (0.02 - e) : -top - slope * (turn - e);
    EXPECT_NEAR(t["stress_11_Pa"][i] - 1, expected, 1e-5 * yield) << e;
    EXPECT_NEAR(t["stress_22_Pa"][i], 1, 1e-5 * yield);
  }
  EXPECT_NEAR(t["state_1"][40], 0.02 - top / young, 1e-8) << "equivalent plastic strain";
  EXPECT_NEAR(t["state_2"][40], top, 1e-4);
}

TEST(FortranAudit, FindsNothingInTheElementDriver) {
  const std::string paths[] = {
      stage("triaxial-drained", "axial_strain = 0.3\nincrements = 60"),
      stage("simple-shear-drained", "shear_strain = 1.5\nincrements = 300"),
      // Axes of strain that turn: F is no exponential of the sum.
      stage("strain", "strain = [0.1, -0.2, 0.05, 0.3, 0, 0]\nincrements = 100") +
          stage("strain", "strain = [-0.3, 0.2, 0.1, 0, 0.4, -0.2]\nincrements = 100"),
      stage("deformation-gradient", "gradient = [1, 4, 0, 0, 1, 0, 0, 0, 1]\nincrements = 800") +
          stage("deformation-gradient",
                "velocity_gradient = [0.2, 1, -2, 0.5, -0.1, 3, 1, 0.3, 0.1]\nincrements = 1000"),
  };
  for (const auto& path : paths) {
    auto t = table(run_path(audit, path, 1e3));
    EXPECT_EQ(t["state_1"].back(), 0) << "codes of audit.f\n" << path;
    EXPECT_EQ(t["state_2"].back(), double(t["step"].size() - 1)) << path;
    EXPECT_LT(t["state_14"].back(), 1) << path;
  }
}

TEST(FortranAudit, FindsNothingInAScene) {
  for (const auto* geometry : {"plane_strain", "axisymmetric", "three_dimensional"})
    for (const int threads : {1, 3}) {
      const bool solid = geometry == std::string("three_dimensional");
      const auto outcome = run_scene(audit, geometry, threads, solid ? 6 : 10);
      EXPECT_EQ(outcome.status, 0);
      EXPECT_EQ(outcome.err, "");
      const auto codes = last("state_1"), increments = last("state_2");
      ASSERT_GE(codes.size(), 100);
      for (const double code : codes) EXPECT_EQ(code, 0) << "codes of audit.f";
      for (const double count : increments) EXPECT_GT(count, 20);
    }
}

TEST(FortranAudit, SpeaksWhereAHostIsWrong) {
  const auto outcome = run_scene(material("audit", "[2e6, 0.25, 1400.0]", 14, "kinematics = \"jaumann\""));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("warning of material audit: audit of AUDIT: code "), std::string::npos)
      << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 10) << "and no more often";
  for (const double code : last("state_1")) EXPECT_EQ(int(code) & (2 + 8), 2 + 8);
}

TEST(FortranScenes, RunInBothFrames) {
  for (const auto& [library, properties, states] :
       {std::tuple{"elastic", "[2e5, 0.25]", 1}, std::tuple{"j2", "[2e5, 0.25, 100.0, 1e4]", 2}})
    for (const auto* kinematics : {"green-naghdi", "jaumann"}) {
      const auto outcome =
          run_scene(material(library, properties, states, fmt::format("kinematics = \"{}\"", kinematics)));
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(outcome.err, "");
      double largest = 0;
      for (const double value : last("state_1")) largest = std::max(largest, value);
      EXPECT_GT(largest, 0) << library << ": state is kept";
    }
}

} // namespace
