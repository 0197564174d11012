// SPDX-License-Identifier: BSD-3-Clause
// Limits, stops and held quantities with the shipped material.
#include "tests/verification/element_fixture.hpp"
#include <algorithm>

using namespace element_fixture;

namespace {

/// Rows at which the direction of axial strain turns.
std::vector<ElementRow> turns(const std::vector<ElementRow>& rows) {
  std::vector<ElementRow> out;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const auto strain = [&](std::size_t k) { return rows[k].point.strain[0]; };
    if ((strain(i) - strain(i - 1)) * (strain(i + 1) - strain(i)) < 0) out.push_back(rows[i]);
  }
  return out;
}

TEST(ElementCyclic, ReversalsLieAtTheStressLimitsWhateverTheIncrement) {
  for (const double increment : {1e-5, 1.7e-4}) {
    const auto rows = rows_of(
        path_text("TS", 0.745, 100e3,
                  stage_text("triaxial-undrained",
                             fmt::format("strain_increment = {}\n[stage.cyclic]\ncycles = 5\n"
                                         "limits = [{{quantity = 'deviator', lower = -25e3, upper = 30e3}}]",
                                         increment))));
    const auto at = turns(rows);
    ASSERT_EQ(at.size(), 9u); // ten legs
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto& s = at[i].point.stress;
      EXPECT_NEAR(s[0] - s[1], i % 2 ? -25e3 : 30e3, 1e-9 * 30e3);
      EXPECT_NEAR(s[1] + at[i].pore_pressure, 100e3, 1e-9 * 100e3);
      EXPECT_NEAR(volumetric_strain(at[i].point.strain), 0, 1e-14);
    }
    EXPECT_EQ(rows.back().cycles, 5);
  }
}

TEST(ElementCyclic, LimitsOnStrainCountFromTheStartOfTheStage) {
  const auto rows = rows_of(path_text(
      "TS", 0.55, 10e3,
      stage_text("triaxial-drained", "axial_strain = 0.01\nincrements = 100\noutput_every = 100\n") +
          stage_text("triaxial-drained",
                     "strain_increment = 3e-5\noutput_every = 1000000\n[stage.cyclic]\ncycles = 2\n"
                     "start = 'lower'\n"
                     "limits = [{quantity = 'axial_strain', lower = -1e-3, upper = 2e-3}]")));
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 2; i < rows.size(); ++i)
    EXPECT_NEAR(rows[i].point.strain[0], i % 2 ? 0.012 : 0.009, 1e-11);
}

TEST(ElementCyclic, LiquefactionEndsTheTest) {
  const auto text = [](const char* stop) {
    return path_text(
        "TS", 0.75, 100e3,
        stage_text("triaxial-undrained",
                   fmt::format("strain_increment = 1e-4\n[stage.cyclic]\ncycles = 5\n"
                               "limits = [{{quantity = 'deviator', lower = -35e3, upper = 35e3}}]\n"
                               "[[stage.stop]]\n{}",
                               stop)));
  };
  const auto flowed = rows_of(text("quantity = 'pore_pressure_ratio'\nabove = 0.95")).back();
  EXPECT_NEAR(flowed.pore_pressure, 0.95 * 100e3, 1e-6);
  EXPECT_NEAR(flowed.point.stress[1], 0.05 * 100e3, 1e-6);
  const auto strained = rows_of(text("quantity = 'double_amplitude'\nabove = 0.05")).back();
  EXPECT_NEAR(strained.double_amplitude, 0.05, 1e-11);
}

TEST(ElementCyclic, AnOpenDrainSetsThePorePressure) {
  const auto rows = rows_of(
      path_text("TS", 0.75, 100e3,
                stage_text("triaxial-undrained", "axial_strain = 0.002\nincrements = 20\n") +
                    stage_text("isotropic", "mean_stress = 100e3\nincrements = 20\npore_pressure = 5e3\n") +
                    stage_text("triaxial-undrained", "axial_strain = 0.001\nincrements = 20\n")));
  EXPECT_GT(rows[20].pore_pressure, 10e3);
  EXPECT_EQ(rows[21].pore_pressure, 5e3);
  EXPECT_NEAR(rows.back().pore_pressure + rows.back().point.stress[1], 5e3 + rows[40].point.stress[1], 1e-4);
  const auto error = error_of([] {
    case_of(path_text(
        "TS", 0.75, 1e3,
        stage_text("triaxial-undrained", "axial_strain = 1\nincrements = 20\npore_pressure = 5e3\n")));
  });
  EXPECT_NE(error.find("key 'stage.pore_pressure': expected a known key"), error.npos) << error;
}

TEST(ElementCyclic, TheCriticalStateEndsATestWhereAllItsMarksAreMet) {
  for (const auto& s : shapes)
    for (const double e0 : {0.6, 0.8}) {
      SCOPED_TRACE(fmt::format("{} {}", s.name, e0));
      const auto rows = rows_of(path_text(
          s.name, e0, 100e3,
          stage_text("triaxial-drained",
                     "axial_strain = 3.0\nstrain_increment = 5e-4\nstop = [{critical_state = 0.01}]")));
      const auto &end = rows.back(), &before = rows[rows.size() - 2];
      EXPECT_LT(end.point.strain[0], 2.9);
      EXPECT_NEAR(q_of(end) / p_of(end) / critical_ratio(s, 1), 1, 0.01);
      EXPECT_NEAR(void_ratio(e0, end), critical_void_ratio(s, p_of(end)), 0.01);
      const Vector6 step = end.point.strain - before.point.strain;
      EXPECT_LT(std::abs(volumetric_strain(step)), 0.01 * deviatoric_strain(step));
    }
}

/// Undrained, dense sand crosses M far from the line: phase transformation is no critical state.
TEST(ElementCyclic, PhaseTransformationIsNoCriticalState) {
  const auto rows = rows_of(path_text(
      "TS", 0.7, 100e3,
      stage_text("triaxial-undrained",
                 "axial_strain = 3.0\nstrain_increment = 5e-4\nstop = [{critical_state = 0.005}]")));
  const Shape& s = shapes[1];
  const auto crossing = std::find_if(rows.begin() + 1, rows.end(),
                                     [&](const auto& r) { return q_of(r) / p_of(r) > critical_ratio(s, 1); });
  ASSERT_NE(crossing, rows.end());
  EXPECT_GT(rows.back().step, 2 * crossing->step);
  EXPECT_NEAR(critical_void_ratio(s, p_of(rows.back())), 0.7, 0.005);
}

TEST(ElementCyclic, LandingIsTheStateThatSmallerStepsReach) {
  const auto end_of = [](double increment) {
    return rows_of(path_text("TS", 0.5, 10e3,
                             stage_text("triaxial-drained",
                                        fmt::format("axial_strain = 0.1\nstrain_increment = {}\n"
                                                    "stop = [{{quantity = 'void_ratio', above = 0.55}}]",
                                                    increment))))
        .back();
  };
  const auto coarse = end_of(1e-3), fine = end_of(2e-5);
  EXPECT_NEAR(void_ratio(0.5, coarse), 0.55, 1e-10);
  // The material's own error at increments of 1e-3 is 1e-3 of q.
  EXPECT_NEAR(coarse.point.strain[0], fine.point.strain[0], 1e-3 * fine.point.strain[0]);
  EXPECT_NEAR(q_of(coarse), q_of(fine), 1e-3 * q_of(fine));
}

TEST(ElementCyclic, ControlsHoldWhatTheyName) {
  const std::string axial = "axial_strain = 0.2\nincrements = 500\noutput_every = 10\n",
                    gamma = "shear_strain = 0.3\nincrements = 500\noutput_every = 10\n";
  const auto rows = [](const std::string& control, const std::string& rest) {
    return rows_of(path_text("TS", 0.6, 10e3, stage_text(control, rest)));
  };
  constexpr double kept = 1e-9 * 10e3;
  for (const auto& r : rows("plane-strain-constant-p", axial)) {
    EXPECT_NEAR(p_of(r), 10e3, kept);
    EXPECT_EQ(r.point.strain[2], 0);
  }
  for (const auto& r : rows("triaxial-constant-volume", axial)) {
    EXPECT_NEAR(volumetric_strain(r.point.strain), 0, 1e-14);
    EXPECT_EQ(r.pore_pressure, 0);
  }
  for (const auto& r : rows("triaxial-lateral", "radial_strain = -0.02\nincrements = 200\n")) {
    EXPECT_NEAR(r.point.stress[0], 10e3, kept);
    EXPECT_NEAR(r.point.stress[1], r.point.stress[2], kept);
  }
  for (const auto& r : rows("torsional-shear-drained", gamma))
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(r.point.stress[c], 10e3, kept);
  for (const auto& r : rows("torsional-shear-undrained", gamma)) {
    EXPECT_NEAR(volumetric_strain(r.point.strain), 0, 1e-14);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(r.point.stress[c] + r.pore_pressure, 10e3, 1e-9 * r.point.stress.norm() + kept);
  }
  for (const auto& r : rows("true-triaxial-undrained", axial + "intermediate_ratio = 0.3\n")) {
    const auto& s = r.point.stress;
    EXPECT_NEAR(s[1] - s[2], 0.3 * (s[0] - s[2]), 1e-8 * s.norm());
    EXPECT_NEAR(s[2] + r.pore_pressure, 10e3, 1e-9 * s.norm());
  }
  for (const auto& r :
       rows("proportional-stress", "axial_stress = 12e3\nincrements = 50\nstress_ratios = [-0.5, -0.25]")) {
    EXPECT_NEAR(r.point.stress[1] - 10e3, -0.5 * (r.point.stress[0] - 10e3), kept);
    EXPECT_NEAR(r.point.stress[2] - 10e3, -0.25 * (r.point.stress[0] - 10e3), kept);
  }
  for (const auto& r :
       rows("proportional-strain", "axial_strain = 0.02\nincrements = 50\nstrain_ratios = [-0.5, -0.4]"))
    EXPECT_NEAR(volumetric_strain(r.point.strain), 0.1 * r.point.strain[0], 1e-14);
  for (const auto& r :
       rows("axisymmetric", "increments = 400\ncondition = [{eps_q = 1, change = 0.1}, {q = 1, p = -3}]"))
    EXPECT_NEAR(r.point.stress[2], 10e3, 3 * kept); // a drained test
  for (const auto& r :
       rows("axisymmetric", "increments = 400\ncondition = [{eps_Q = 1, change = 0.1}, {P = 1}]"))
    EXPECT_NEAR(p_of(r), 10e3, kept);
}

} // namespace
