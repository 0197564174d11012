// SPDX-License-Identifier: BSD-3-Clause
// Every control on linear elasticity, in a library of its own, against closed forms.
#include "tests/verification/element_fixture.hpp"

using namespace element_fixture;

namespace {

constexpr double E = 7e6, nu = 0.3, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu)), // Pa
    lame = K - 2 * G / 3, p0 = 100e3;

std::string elastic_text(const std::string& stages, double p = p0) {
  return fmt::format("[material]\nlibrary = '{}/test_vumats/libelastic.so'\nname = 'elastic'\n"
                     "properties = [{}, {}]\nstate_variables = 1\ndensity = 1500.0\n[initial]\n"
                     "mean_stress = {}\n{}",
                     SIMSAND_BINARY_DIR, toml_number(E), nu, toml_number(p), stages);
}

/// A control and its drive, and what elasticity answers: a component of stress (change) over a drive of 1e-3, and
/// the change of pore pressure.
struct Known {
  std::string control, drive;
  int component;
  double stress, pore_pressure = 0; // per unit of drive
  std::string more{};
};

const std::vector<Known> known{
    {"isotropic", "volumetric_strain", 0, K},
    {"oedometric", "axial_strain", 0, lame + 2 * G},
    {"oedometric", "axial_strain", 1, lame},
    {"triaxial-drained", "axial_strain", 0, E},
    {"triaxial-undrained", "axial_strain", 0, 2 * G, G}, // q = 3 G eps_q at constant p'
    {"triaxial-constant-p", "axial_strain", 1, -G},
    {"triaxial-constant-volume", "axial_strain", 0, 2 * G},
    {"triaxial-lateral", "radial_strain", 1, E / (1 - nu)},
    {"plane-strain-drained", "axial_strain", 0, E / (1 - nu * nu)},
    {"plane-strain-drained", "axial_strain", 2, nu* E / (1 - nu * nu)},
    {"plane-strain-undrained", "axial_strain", 0, 2 * G, 2 * G},
    {"plane-strain-constant-p", "axial_strain", 1, -2 * G},
    {"simple-shear-drained", "shear_strain", 3, G},
    {"simple-shear-undrained", "shear_strain", 3, G},
    {"torsional-shear-drained", "shear_strain", 3, G},
    {"torsional-shear-undrained", "shear_strain", 3, G},
    {"true-triaxial-drained", "axial_strain", 0, E / (1 - 0.25 * nu), 0, "intermediate_ratio = 0.25\n"},
    {"true-triaxial-undrained", "axial_strain", 0, 2 * G, 2 * G,
     "intermediate_ratio = 0.5\n"}, // ds33 = -ds11
    {"true-triaxial-constant-p", "axial_strain", 0, 2 * G, 0, "intermediate_ratio = 0.25\n"},
    {"proportional-stress", "axial_strain", 0, E / (1 - nu * (0.2 - 0.5)), 0,
     "stress_ratios = [0.2, -0.5]\n"},
    {"proportional-strain", "axial_strain", 2, lame * 0.7 - 0.5 * 2 * G, 0, "strain_ratios = [0.2, -0.5]\n"},
};

TEST(ElementElastic, EveryPresetIsItsClosedForm) {
  for (const auto& k : known) {
    SCOPED_TRACE(k.control + " " + std::to_string(k.component));
    const auto rows = rows_of(
        elastic_text(stage_text(k.control, fmt::format("{} = 1e-3\nincrements = 3\n{}", k.drive, k.more))));
    ASSERT_EQ(rows.size(), 4u);
    const auto& end = rows.back();
    EXPECT_NEAR(end.point.stress[k.component] - (k.component < 3 ? p0 : 0), 1e-3 * k.stress, 1e-8 * E);
    EXPECT_NEAR(end.pore_pressure, 1e-3 * k.pore_pressure, 1e-8 * E);
  }
}

TEST(ElementElastic, ADeviatorMayDriveATriaxialTest) {
  const auto rows =
      rows_of(elastic_text(stage_text("triaxial-undrained", "deviator = -30e3\nincrements = 2\n")));
  EXPECT_NEAR(rows.back().point.strain[0], -30e3 / (3 * G), 1e-12);
}

TEST(ElementElastic, NamedConditionsAreTheirClosedForms) {
  const auto end = [](const std::string& control, const std::string& conditions) {
    return rows_of(elastic_text(stage_text(control, "increments = 2\ncondition = [" + conditions + "]")))
        .back();
  };
  const auto drained = end("axisymmetric", "{eps_q = 1, change = 1e-3}, {q = 1, p = -3}");
  EXPECT_NEAR(drained.point.stress[0] - p0, 3 * G * 1e-3, 1e-3);
  EXPECT_NEAR(drained.point.stress[1], p0, 1e-4);
  const auto isochoric = end("axisymmetric", "{Q = 1, final = 9e3}, {eps_P = 1}");
  EXPECT_NEAR(strain_deviator(isochoric), std::sqrt(1.5) * 9e3 / (3 * G), 1e-12);
  const auto biaxial = end("principal", "{stress_11 = 1, final = 110e3}, {stress_22 = 1}, {eps_v = 1}");
  EXPECT_NEAR(biaxial.point.stress[2], p0 - 10e3, 1e-3);
}

/// Undrained, p' does not move: a reversal at q = +-L lies at the axial strain +-L / 3G.
TEST(ElementElastic, CyclesTurnAtTheirLimits) {
  constexpr double limit = 20e3;
  for (const bool up : {true, false}) {
    const auto rows = rows_of(elastic_text(
        stage_text("triaxial-undrained",
                   fmt::format("strain_increment = 1.3e-4\noutput_every = 1000000\n[stage.cyclic]\n"
                               "cycles = 4\nstart = '{}'\n"
                               "limits = [{{quantity = 'q', lower = -20e3, upper = 20e3}}]",
                               up ? "upper" : "lower"))));
    ASSERT_EQ(rows.size(), 9u); // the start and eight reversals
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double sign = (i % 2 == 1) == up ? 1 : -1;
      EXPECT_NEAR(q_of(rows[i]), limit, 1e-8 * limit);
      EXPECT_NEAR(rows[i].point.strain[0], sign * limit / (3 * G), 1e-11);
      EXPECT_EQ(rows[i].cycles, 0.5 * double(i));
      EXPECT_NEAR(rows[i].double_amplitude, (i > 1 ? 2 : 1) * limit / (3 * G), 2e-11);
    }
  }
}

TEST(ElementElastic, TheFirstLimitThatIsMetTurnsTheDrive) {
  const auto rows = rows_of(elastic_text(stage_text(
      "triaxial-drained", "strain_increment = 1e-4\noutput_every = 1000000\n[stage.cyclic]\ncycles = 2\n"
                          "limits = [{quantity = 'axial_strain', lower = -1e-3, upper = 1e-2},\n"
                          "{quantity = 'deviator', lower = -50e3, upper = 21e3}]")));
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(rows[i].point.strain[0], i % 2 ? 3e-3 : -1e-3, 1e-11);
}

TEST(ElementElastic, AStressMayDriveTheCycles) {
  const auto rows = rows_of(elastic_text(stage_text(
      "simple-shear-drained",
      "stress_increment = 170.0\noutput_every = 1000000\n[stage.cyclic]\ncycles = 2\n"
      "drive = 'shear_stress'\nlimits = [{quantity = 'shear_strain', lower = -1e-3, upper = 2e-3}]")));
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t i = 1; i < 5; ++i)
    EXPECT_NEAR(rows[i].point.stress[3], G * (i % 2 ? 2e-3 : -1e-3), 1e-5 * G * 1e-3);
}

TEST(ElementElastic, ALimitOutOfReachIsAnErrorThatNamesTheLeg) {
  const auto error = error_of([] {
    rows_of(elastic_text(stage_text(
        "triaxial-drained", "strain_increment = 1e-4\n[stage.cyclic]\ncycles = 2\nleg_increments = 50\n"
                            "limits = [{quantity = 'shear_stress', lower = -1, upper = 1}]")));
  });
  EXPECT_EQ(error, "path.toml:9: stage 1 'shear', step 50, leg 1 of 4: no limit met in 50 increments");
}

/// Of two bounds passed in one increment the earlier one is landed on.
TEST(ElementElastic, AStopLandsOnTheFirstBound) {
  const auto rows = rows_of(elastic_text(
      stage_text("triaxial-drained",
                 "axial_strain = 0.01\nincrements = 1\n"
                 "stop = [{quantity = 'q', above = 60e3}, {quantity = 'axial_strain', above = 4e-3},\n"
                 "{quantity = 'p', above = 112e3}]")));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(rows.back().point.strain[0], 4e-3, 1e-12); // q = 28 kPa, p = 109.3 kPa
  EXPECT_NEAR(rows.back().point.time, 0.4, 1e-9);
}

/// In the Rendulic plane elasticity has the eigenvalues 3 K, isotropic, and 2 G, deviatoric: the response to a
/// circle of strain is an ellipse with these half axes.
TEST(ElementElastic, TheResponseEnvelopeIsTheKnownEllipse) {
  constexpr double norm = 1e-4;
  const auto element = case_of(elastic_text(
      stage_text("triaxial-drained", "axial_strain = 1e-3\nincrements = 2") +
      stage_text("envelope", fmt::format("strain_norm = {}\ndirections = 90\nincrements = 3", norm))));
  std::vector<EnvelopeRow> rows;
  const auto last = run_element_case(
      element, [](const ElementRow&) {}, [&](const EnvelopeRow& r) { rows.push_back(r); });
  ASSERT_EQ(rows.size(), 90u);
  EXPECT_EQ(last.stage, 2);
  EXPECT_NEAR(last.point.strain[0], 1e-3, 1e-15); // a probe does not move the point
  double axial2 = 0, radial2 = 0, both = 0;       // second moments of the response over strain
  for (const auto& r : rows) {
    EXPECT_NEAR(std::sqrt(r.strain_increment.dot(r.strain_increment)), norm, 1e-15);
    EXPECT_NEAR(std::atan2(r.strain_increment[0], std::sqrt(2) * r.strain_increment[1]),
                std::remainder(r.angle * M_PI / 180, 2 * M_PI), 1e-9);
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(r.stress[c] - r.stress_change[c], last.point.stress[c], 1e-12 * p0);
    const double radial = std::sqrt(2) * r.stress_change[1] / norm, axial = r.stress_change[0] / norm;
    const double isotropic = (std::sqrt(2) * radial + axial) / std::sqrt(3),
                 deviatoric = (std::sqrt(2) * axial - radial) / std::sqrt(3);
    EXPECT_NEAR(std::pow(isotropic / (3 * K), 2) + std::pow(deviatoric / (2 * G), 2), 1, 1e-9);
    axial2 += axial * axial / 45;
    radial2 += radial * radial / 45;
    both += axial * radial / 45;
  }
  // Eigenvalues of the moments: the half axes squared; direction of the long one.
  const double mean = (axial2 + radial2) / 2, half = std::hypot((axial2 - radial2) / 2, both);
  EXPECT_NEAR(std::sqrt(mean + half), 3 * K, 1e-8 * K);
  EXPECT_NEAR(std::sqrt(mean - half), 2 * G, 1e-8 * K);
  EXPECT_NEAR(std::atan2(both, (radial2 - axial2) / 2) / 2, std::atan(std::sqrt(0.5)), 1e-9);
}

TEST(ElementElastic, AnotherMaterialMayNameItsCriticalState) {
  const auto stage = stage_text("triaxial-drained", "axial_strain = 1e-3\nincrements = 2\n");
  const auto names = [](const ElementCase& element) {
    std::vector<std::string> out;
    for (const auto& q : output_columns(element.material, element.critical)) out.push_back(q.name);
    return out;
  };
  const auto has = [](const std::vector<std::string>& all, const char* name) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  const auto without = names(case_of(elastic_text(stage)));
  EXPECT_FALSE(has(without, "critical_void_ratio"));
  EXPECT_FALSE(has(without, "void_ratio"));
  const auto element = case_of(elastic_text(
      "void_ratio = 0.7\n" + stage + "[critical_state]\nphi = 30\ne_ref = 0.9\nlambda = 0.05\nzeta = 0.5"));
  EXPECT_TRUE(has(names(element), "critical_void_ratio"));
  EXPECT_NEAR(element.critical->stress_ratio(-30), 1.2, 1e-14);
  EXPECT_NE(error_of([&] {
              case_of(elastic_text(stage + "stop = [{critical_state = 0.01}]"));
            }).find("expected a void ratio, and SIMSAND or a table [critical_state], found none"),
            std::string::npos);
}

} // namespace
