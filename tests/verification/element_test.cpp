// SPDX-License-Identifier: BSD-3-Clause
// The element driver with the shipped material, against an independent integration of the equations
// (data/reference/element_drained.csv), closed forms, and the critical state.
#include "drivers/element/command.hpp"
#include "tests/verification/element_fixture.hpp"
#include <cmath>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <sstream>

using namespace element_fixture;

namespace {

struct ReferenceTest {
  std::string shape;
  double e0, cell;                           // -, Pa
  std::vector<std::array<double, 3>> points; // axial strain, q in Pa, void ratio
};

std::vector<ReferenceTest> reference_tests() {
  std::ifstream file(SIMSAND_SOURCE_DIR "/data/reference/element_drained.csv");
  std::vector<ReferenceTest> tests;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.starts_with("shape")) continue;
    std::istringstream in(line);
    std::string shape, cell;
    std::getline(in, shape, ',');
    std::array<double, 7> v;
    for (auto& x : v) std::getline(in, cell, ','), x = std::stod(cell);
    if (tests.empty() || tests.back().shape != shape || tests.back().e0 != v[0] ||
        tests.back().cell != 1e3 * v[1])
      tests.push_back({shape, v[0], 1e3 * v[1], {}});
    tests.back().points.push_back({v[2], 1e3 * v[4], v[5]});
  }
  return tests;
}

/// Largest deviations of q and e from the reference, over the largest q and e.
std::array<double, 2> deviation(const ReferenceTest& t, double increment) {
  const long every = std::lround(0.005 / increment); // rows of the reference
  const auto rows = rows_of(path_text(t.shape, t.e0, t.cell,
                                      stage_text("triaxial-drained", fmt::format("axial_strain = 0.4\n"
                                                                                 "strain_increment = {}\n"
                                                                                 "output_every = {}",
                                                                                 increment, every))));
  EXPECT_EQ(rows.size(), t.points.size());
  double q_error = 0, e_error = 0, q_most = 0, e_most = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].point.strain[0], t.points[i][0], 1e-12);
    q_most = std::max(q_most, t.points[i][1]);
    e_most = std::max(e_most, t.points[i][2]);
    q_error = std::max(q_error, std::abs(q_of(rows[i]) - t.points[i][1]));
    e_error = std::max(e_error, std::abs(void_ratio(t.e0, rows[i]) - t.points[i][2]));
  }
  return {q_error / q_most, e_error / e_most};
}

TEST(Element, DrainedTriaxialMatchesTheIndependentIntegration) {
  const auto tests = reference_tests();
  ASSERT_EQ(tests.size(), 12u);
  for (const auto& t : tests) {
    SCOPED_TRACE(fmt::format("{} e0 {} cell {} Pa", t.shape, t.e0, t.cell));
    const auto fine = deviation(t, 1e-5), coarse = deviation(t, 1e-3);
    fmt::print("{} {:5} {:5} Pa: q {:.1e} e {:.1e} at 1e-5, q {:.1e} e {:.1e} at 1e-3\n", t.shape, t.e0,
               t.cell, fine[0], fine[1], coarse[0], coarse[1]);
    EXPECT_LT(fine[0], 1e-3);
    EXPECT_LT(fine[1], 1e-3);
    EXPECT_LT(coarse[0], 1e-2);
    EXPECT_LT(coarse[1], 1e-2);
  }
}

TEST(Element, DrainedTestsEndOnTheCriticalStateLine) {
  for (const auto& s : shapes)
    for (const double e0 : {0.5, 0.8})
      for (const double cell : {2e3, 100e3})
        for (const double sign : {1.0, -1.0}) {
          SCOPED_TRACE(fmt::format("{} e0 {} cell {} Pa sign {}", s.name, e0, cell, sign));
          const auto rows = rows_of(
              path_text(s.name, e0, cell,
                        stage_text("triaxial-drained",
                                   fmt::format("axial_strain = {}\nincrements = 4000\noutput_every = 4000",
                                               sign * 3))));
          const auto& end = rows.back();
          EXPECT_NEAR(q_of(end) / p_of(end), critical_ratio(s, sign), 2e-3);
          EXPECT_NEAR(void_ratio(e0, end), critical_void_ratio(s, p_of(end)), 1e-3);
          EXPECT_NEAR(lode_angle(end.point.stress), -sign * 30, 1e-3);
          EXPECT_NEAR(end.point.stress[1], cell, 1e-6 * cell);
          EXPECT_NEAR(end.point.state[0], void_ratio(e0, end), 1e-10); // the material's own count
        }
}

TEST(Element, UndrainedKeepsVolumeAndTotalStressAndEndsOnTheCriticalStateLine) {
  const Shape& s = shapes[1];
  for (const double e0 : {0.70, 0.74}) // critical at 500 and at 10 kPa
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(fmt::format("e0 {} sign {}", e0, sign));
      auto text = path_text(
          s.name, e0, 100e3,
          stage_text("triaxial-undrained",
                     fmt::format("axial_strain = {}\nincrements = 10000\noutput_every = 100", sign * 3)));
      text.insert(text.find("[[stage]]"), "pore_pressure = 50e3\n");
      const auto rows = rows_of(text);
      for (const auto& r : rows) {
        EXPECT_NEAR(volumetric_strain(r.point.strain), 0, 1e-14);
        EXPECT_NEAR(r.point.stress[1] + r.pore_pressure, 150e3, 1e-6);
      }
      const auto& end = rows.back();
      EXPECT_NEAR(q_of(end) / p_of(end), critical_ratio(s, sign), 2e-3);
      EXPECT_NEAR(critical_void_ratio(s, p_of(end)), e0, 1e-3);
    }
}

TEST(Element, OedometricPathHasNoLateralStrain) {
  const auto rows = rows_of(path_text("TS", 0.75, 5e3,
                                      stage_text("oedometric", "axial_stress = 100e3\nincrements = 200") +
                                          stage_text("oedometric", "axial_stress = 20e3\nincrements = 200")));
  for (const auto& r : rows)
    for (int c = 1; c < 6; ++c) EXPECT_NEAR(r.point.strain[c], 0, 1e-15);
  EXPECT_NEAR(rows[200].point.stress[0], 100e3, 1e-3);
  EXPECT_NEAR(rows[400].point.stress[0], 20e3, 1e-3);
  EXPECT_GT(rows[400].point.stress[1] / rows[400].point.stress[0],
            rows[200].point.stress[1] / rows[200].point.stress[0]); // lateral stress stays after unloading
}

/// dp = K d eps_v with (1) and (10): p^(1-n) grows by (1-n) K0 p_at^(1-n) times the integral of
/// ((2.97 - e) / (1 + e))^2 de, taken downwards.
double pressure_at(double e, double e0, double p0) {
  const double K0 = 100, n = 0.51;
  const auto integral = [](double x) {
    const double u = 1 + x;
    return -3.97 * 3.97 / u - 2 * 3.97 * std::log(u) + u;
  };
  return std::pow(std::pow(p0, 1 - n) + (1 - n) * K0 * std::pow(p_at, 1 - n) * (integral(e0) - integral(e)),
                  1 / (1 - n));
}

TEST(Element, IsotropicPathIsTheClosedFormOfTheElasticity) {
  for (const double p0 : {10.0, 1e3, 1e5}) {
    const auto rows = rows_of(
        path_text("TS", 0.7, p0,
                  stage_text("isotropic", fmt::format("mean_stress = {}\nincrements = 50", 1000 * p0)) +
                      stage_text("isotropic", fmt::format("mean_stress = {}\nincrements = 50", p0))));
    for (const auto& r : rows) {
      // Back at a thousandth of the stress, the round-off of the largest one is a deviator that counts.
      EXPECT_NEAR(p_of(r) / pressure_at(void_ratio(0.7, r), 0.7, p0), 1, r.stage < 2 ? 1e-8 : 1e-4);
      EXPECT_LT(q_of(r), 1e-6 * p_of(r));
    }
    EXPECT_NEAR(p_of(rows.back()), p0, 1e-6 * p0);
    EXPECT_NEAR(volumetric_strain(rows.back().point.strain), 0, 1e-9); // elastic: the loop closes
  }
}

TEST(Element, PresetsHoldWhatTheyName) {
  const std::string shear = "axial_strain = 0.2\nincrements = 500\noutput_every = 10\n";
  for (const auto& r : rows_of(path_text("TS", 0.55, 10e3, stage_text("triaxial-constant-p", shear))))
    EXPECT_NEAR(p_of(r), 10e3, 1e-4);
  for (const auto& r : rows_of(path_text("TS", 0.55, 10e3, stage_text("plane-strain-drained", shear)))) {
    EXPECT_NEAR(r.point.strain[2], 0, 1e-15);
    EXPECT_NEAR(r.point.stress[1], 10e3, 1e-4);
  }
  for (const auto& r : rows_of(path_text(
           "TS", 0.55, 10e3, stage_text("true-triaxial-drained", shear + "intermediate_ratio = 0.3")))) {
    const auto& s = r.point.stress;
    EXPECT_NEAR(s[1] - s[2], 0.3 * (s[0] - s[2]), 1e-3);
    EXPECT_NEAR(s[2], 10e3, 1e-3);
  }
  const std::string gamma = "shear_strain = 0.4\nincrements = 500\noutput_every = 10\n";
  const auto rows = rows_of(path_text("TS", 0.55, 10e3, stage_text("simple-shear-drained", gamma)));
  for (const auto& r : rows) {
    EXPECT_NEAR(r.point.stress[0], 10e3, 1e-4);
    EXPECT_NEAR(r.point.strain[1], 0, 1e-15);
  }
  EXPECT_NEAR(rows.back().point.strain[3], 0.2, 1e-15); // tensor
  EXPECT_GT(rows.back().point.stress[3], 3e3);
}

/// In strides that a user would call coarse; loose sand sheared undrained liquefies on the way.
TEST(Element, ConvergesFromOnePascalToOneMegapascal) {
  for (const auto& s : shapes)
    for (const double e0 : {0.45, 0.85})
      for (const double p : {1.0, 1e3, 1e6})
        for (const std::string control : {"triaxial-drained", "triaxial-constant-p", "plane-strain-drained",
                                          "true-triaxial-drained", "triaxial-undrained"})
          for (const double axial : {0.3, -0.3}) {
            const auto rest =
                fmt::format("axial_strain = {}\nincrements = 150\n{}", axial,
                            control == "true-triaxial-drained" ? "intermediate_ratio = 0.5" : "");
            EXPECT_EQ(error_of([&] { rows_of(path_text(s.name, e0, p, stage_text(control, rest))); }), "")
                << s.name << " e0 " << e0 << " p " << p << " " << control << " " << axial;
          }
}

TEST(Element, AStopRuleEndsTheStageOnItsBound) {
  const auto rows =
      rows_of(path_text("TS", 0.44, 10e3,
                        stage_text("triaxial-drained", "axial_strain = 0.4\nstrain_increment = 1e-3\n"
                                                       "stop = [{quantity = 'q', above = 50e3}]") +
                            stage_text("triaxial-drained", "axial_strain = -0.001\nincrements = 10")));
  const auto end = std::find_if(rows.begin(), rows.end(), [](const auto& r) { return q_of(r) > 50e3; });
  ASSERT_NE(end, rows.end());
  EXPECT_EQ(end->stage, 1);
  EXPECT_EQ((end + 1)->stage, 2);
  EXPECT_NEAR(q_of(*end), 50e3, 1e-9 * 50e3);
  EXPECT_NEAR(end->point.strain[0] + rows.back().point.strain[0], 2 * end->point.strain[0] - 0.001, 1e-12);
}

TEST(Element, AStressThatCannotBeReachedIsAnErrorWithTheEvidence) {
  const auto text =
      path_text("SS", 0.82, 10e3, stage_text("triaxial-drained", "axial_stress = 60e3\nincrements = 50"));
  const auto error = error_of([&] { rows_of(text); });
  EXPECT_TRUE(error.starts_with("path.toml:6: stage 1 'shear', step ")) << error;
  EXPECT_NE(error.find(" of 50: condition 1 of 6 misses by "), error.npos) << error;
  EXPECT_NE(error.find(" Pa; "), error.npos) << error;
  EXPECT_EQ(error.find('\n'), error.npos);
}

TEST(Element, AMaterialThatReturnsNaNIsAnErrorNamingStageAndStep) {
  auto element = case_of(
      path_text("SS", 0.82, 10e3, stage_text("triaxial-drained", "axial_strain = 0.1\nincrements = 50")));
  element.material.material.properties[12] = -1; // p_at: refused by the material
  const auto refused = error_of([&] { run_element_case(element, [](const ElementRow&) {}); });
  EXPECT_TRUE(refused.starts_with("path.toml:6: stage 1 'shear', step 0 of 50: no elastic stiffness from the "
                                  "data check; material SIMSAND reported a "
                                  "failure, state variable 4 is -"))
      << refused;
  element.material.failure_state = -1; // a material without a status
  const auto nan = error_of([&] { run_element_case(element, [](const ElementRow&) {}); });
  EXPECT_TRUE(nan.starts_with("path.toml:6: stage 1 'shear', step 0 of 50: no elastic stiffness from the "
                              "data check; material SIMSAND returned a number that is "
                              "not finite, component 1 of stressNew: at time "))
      << nan;
  EXPECT_EQ(nan.find("replay"), nan.npos) << "no file unless one is named";
}

TEST(Element, ALibraryWithoutVumatIsAnError) {
  Dl_info info;
  ASSERT_NE(dladdr(reinterpret_cast<void*>(&dlopen), &info), 0); // the C library
  auto text =
      path_text("SS", 0.82, 10e3, stage_text("triaxial-drained", "axial_strain = 0.1\nincrements = 50"));
  text.insert(text.find("[initial]"), fmt::format("library = '{}'\n", info.dli_fname));
  const auto error = error_of([&] { case_of(text); });
  EXPECT_TRUE(error.starts_with("path.toml:3: key 'library': ")) << error;
  EXPECT_NE(error.find("vumat_"), error.npos) << error;
}

TEST(Element, TheResolvedPathGivesTheSameRows) {
  const auto text =
      path_text("TS", 0.44, 10e3, stage_text("triaxial-drained", "axial_strain = 0.05\nincrements = 77"));
  const auto first = rows_of(text), again = rows_of(case_of(text).resolved);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].point.stress, again[i].point.stress);
}

TEST(Element, TheCommandWritesItsHeaderAndReportsErrorsByItsResult) {
  const auto output = testing::TempDir() + "/element.csv";
  ASSERT_EQ(run_element({paths + "/ts_dense_10kpa.toml", output, "", ""}), 0);
  std::ifstream file(output);
  std::string header;
  std::getline(file, header);
  EXPECT_EQ(
      header,
      "stage,step,time_s,strain_11,strain_22,strain_33,strain_12,strain_23,strain_31,stress_11_Pa,"
      "stress_22_Pa,stress_33_Pa,stress_12_Pa,stress_23_Pa,stress_31_Pa,p_Pa,q_Pa,deviator_Pa,lode_angle_deg,"
      "volumetric_strain,deviatoric_strain,void_ratio,critical_void_ratio,critical_stress_ratio,"
      "pore_pressure_Pa,pore_pressure_ratio,total_mean_stress_Pa,cycles,double_amplitude,state_void_ratio,"
      "state_plastic_deviatoric_strain,state_separation_strain,state_status,state_nonconvex_updates,"
      "internal_energy_J_per_kg,inelastic_energy_J_per_kg,iterations,cuts");
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_element({"/no/such.toml", output, "", ""}), 1);
  const auto error = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1);
}

} // namespace
