// SPDX-License-Identifier: BSD-3-Clause
// Calibration: the simulation against the element driver, recovery of known parameters, what shipped fits promise.
#include "calibration/coverage.hpp"
#include "calibration/report.hpp"
#include "drivers/element/element.hpp"
#include "drivers/files/scene_file.hpp"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <omp.h>
#include <set>

namespace {

using namespace calibration;

std::string shipped(const std::string& path) {
  return std::string(SIMSAND_SOURCE_DIR) + "/data/" + path;
}

drivers::LoadedMaterial spheres() {
  return drivers::read_material(
      drivers::parse_toml("file = \"" + shipped("materials/SS.toml") + "\"", "material", "."), 0.6);
}

/// The shipped fit after `change` has edited its text.
Fit changed_fit(const std::string& name, const std::function<void(std::string&)>& change) {
  std::ifstream in(shipped("fits/" + name));
  std::string text(std::istreambuf_iterator<char>(in), {});
  for (std::size_t at; (at = text.find("../")) != text.npos;) text.replace(at, 3, shipped(""));
  change(text);
  const auto folder = std::filesystem::path(SIMSAND_BINARY_DIR) / "test_results" / "calibration";
  std::filesystem::create_directories(folder);
  const auto file =
      (folder / (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml"))
          .string();
  std::ofstream(file) << text;
  auto fit = read_fit(file);
  fit.output_folder = folder.string();
  return fit;
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  ASSERT_NE(at, text.npos) << from;
  text.replace(at, from.size(), to);
}

/// Rows of the element driver at the end of each increment: axial strain, q/p, volumetric strain, p.
std::vector<std::array<double, 4>> driver_rows(const Specimen& s, const std::string& control, double strain,
                                               double increment) {
  const auto document = drivers::parse_toml(
      fmt::format("[material]\nfile = \"{}\"\n[initial]\nmean_stress = {}\nvoid_ratio = "
                  "{}\n[[stage]]\ncontrol = \"{}\"\n"
                  "axial_strain = {:.17g}\nstrain_increment = {}\noutput_every = 50\n",
                  shipped("materials/SS.toml"), drivers::toml_number(s.radial_stress),
                  drivers::toml_number(s.void_ratio), control, strain, drivers::toml_number(increment)),
      "path", ".");
  std::vector<std::array<double, 4>> rows;
  drivers::run_element_case(drivers::read_element_case(document), [&](const drivers::ElementRow& row) {
    const double p = drivers::mean_stress(row.point.stress), q = row.point.stress[0] - row.point.stress[1];
    rows.push_back({row.point.strain[0], q / p, drivers::volumetric_strain(row.point.strain), p});
  });
  return rows;
}

struct Agreement {
  const char* kind;
  double void_ratio, stress, strain;
};
class AgainstDriver : public testing::TestWithParam<Agreement> {};

// The driver in increments of 2e-5 takes another way to the same equilibrium: full Newton in six components.
TEST_P(AgainstDriver, StressRatioToThreeInTenThousand) {
  const auto [kind, e0, stress, strain] = GetParam();
  const Specimen specimen{drivers::find_axisymmetric_test(kind), e0, stress, stress, strain};
  const auto rows = driver_rows(specimen, kind, strain, 2e-5);
  const auto material = spheres();
  Simulator simulator(material, {specimen});
  const auto path = simulator.run(material.material.properties).front();
  ASSERT_TRUE(path.complete);
  std::vector<double> at, ratio, volume, mean;
  for (const auto& row : rows) at.push_back(row[0]);
  at.back() = strain;
  ratio.resize(at.size());
  volume = mean = ratio;
  ASSERT_EQ(interpolate(path, specimen, Measure::stress_ratio, at, ratio), at.size());
  ASSERT_EQ(interpolate(path, specimen, Measure::volumetric_strain, at, volume), at.size());
  ASSERT_EQ(interpolate(path, specimen, Measure::mean_stress, at, mean), at.size());
  double most = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_NEAR(ratio[i], rows[i][1], 3e-4) << at[i];
    EXPECT_NEAR(volume[i], rows[i][2], 3e-5) << at[i];
    EXPECT_NEAR(mean[i] / rows[i][3], 1, 1e-3) << at[i];
    most = std::max(most, std::abs(rows[i][1]));
  }
  EXPECT_GT(most, 0.4); // something was sheared
}
INSTANTIATE_TEST_SUITE_P(Kinds, AgainstDriver,
                         testing::Values(Agreement{"triaxial-drained", 0.58, 10e3, 0.2},
                                         Agreement{"triaxial-drained", 0.8, 2e3, 0.2},
                                         Agreement{"triaxial-drained", 0.58, 5e3, -0.1},
                                         Agreement{"triaxial-undrained", 0.7, 100e3, 0.1},
                                         Agreement{"triaxial-undrained", 0.62, 20e3, -0.05},
                                         Agreement{"triaxial-constant-p", 0.65, 50e3, 0.1},
                                         Agreement{"triaxial-constant-volume", 0.7, 100e3, 0.1},
                                         Agreement{"oedometric", 0.7, 10e3, 0.02}));

TEST(Simulator, TestsDoNotSeeEachOther) {
  const auto material = spheres();
  const auto& kinds = drivers::axisymmetric_tests();
  std::vector<Specimen> specimens;
  for (int i = 0; i < 150; ++i) // more than a block holds
    specimens.push_back(
        {&kinds[i % kinds.size()], 0.58 + 0.001 * i, 2e3 + 50 * i, 2e3 + 50 * i, i % 2 ? 0.05 : -0.03});
  Simulator together(material, specimens);
  const auto paths = together.run(material.material.properties);
  for (const int i : {0, 1, 77, 149}) {
    Simulator alone(material, {specimens[i]});
    const auto& path = alone.run(material.material.properties).front();
    EXPECT_EQ(path.axial_strain, paths[i].axial_strain);
    EXPECT_EQ(path.axial_stress, paths[i].axial_stress);
    EXPECT_EQ(path.volumetric_strain, paths[i].volumetric_strain);
  }
}

TEST(Simulator, RefusedPropertiesGiveIncompletePathsAndFiniteResiduals) {
  const auto fit = changed_fit("ss_recovery.toml", [](std::string&) {});
  Objective objective(fit);
  Eigen::VectorXd u(fit.unknowns.size());
  for (Eigen::Index d = 0; d < u.size(); ++d) u[d] = fit.unknowns[d].highest();
  u[1] = 3; // e_ref beyond what the material takes
  const Eigen::MatrixXd r = objective.residuals(u);
  EXPECT_TRUE(r.allFinite());
  EXPECT_GT(r.squaredNorm(), 1e4);
  EXPECT_EQ(objective.failures(), 1);
  EXPECT_EQ(objective.log_posterior(u)[0], -std::numeric_limits<double>::infinity()); // outside its bounds
}

TEST(Recovery, SixParametersFromCleanCurvesAndRemoteStarts) {
  const auto fit =
      changed_fit("ss_recovery.toml", [](std::string& text) { replace(text, "starts = 12", "starts = 3"); });
  Objective objective(fit);
  const auto best = least_squares(objective);
  const auto known = identify(objective, best);
  ASSERT_EQ(fit.parameters(), 6);
  int recovered = 0;
  for (const auto& search : best.searches) {
    bool all = true;
    for (int d = 0; d < 6; ++d) {
      const auto& p = fit.unknowns[d];
      const double truth = fit.synthetic->properties[p.property];
      all = all && std::abs(p.value(search.end[d]) / truth - 1) < 0.01;
    }
    recovered += all;
  }
  EXPECT_GE(recovered, 2);
  for (int d = 0; d < 6; ++d) {
    const auto& p = fit.unknowns[d];
    EXPECT_NEAR(p.value(best.best.end[d]) / fit.synthetic->properties[p.property], 1, 0.01) << p.name;
    EXPECT_EQ(known.findings[d], Finding::determined) << p.name;
  }
}

TEST(Recovery, ThreadsDoNotChangeIt) {
  const auto fit = changed_fit("ss_noise.toml",
                               [](std::string& text) { replace(text, "candidates = 16", "candidates = 2"); });
  const int before = omp_get_max_threads();
  Eigen::VectorXd ends[2];
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    Objective objective(fit);
    ends[threads / 2] = least_squares(objective).best.end;
  }
  omp_set_num_threads(before);
  EXPECT_EQ(ends[0], ends[1]);
}

TEST(Report, BestSetIsAMaterialThatASceneTakes) {
  const auto fit = changed_fit("ss_noise.toml", [](std::string& text) {
    replace(text, "starts = 2", "starts = 1");
    replace(text, "burn_in = 400", "burn_in = 30");
    replace(text, "steps = 1600", "steps = 40\npredictive_sets = 40");
  });
  Objective objective(fit);
  const auto best = least_squares(objective);
  const auto known = identify(objective, best);
  auto posterior = sample_posterior(objective, best, known, *fit.sampling);
  predict_bands(objective, *fit.sampling, posterior);
  const auto files = write_report({objective, best, known, &posterior, "a test", 0});
  EXPECT_EQ(files.size(), 4u);
  for (const auto& band : posterior.bands) EXPECT_GT(band.coverage, 0.6);
  const auto report = drivers::read_toml(fit.output_folder + "/report.toml");
  EXPECT_EQ(report.tables("parameter").size(), 6u);

  const auto scene_file = fit.output_folder + "/scene.toml";
  std::ofstream(scene_file) << fmt::format(
      "[scene]\ngeometry = \"axisymmetric\"\nspacing = 0.01\n[column]\nradius = 0.05\nheight = "
      "0.05\n[material]\n"
      "file = \"{}\"\nvoid_ratio = 0.6\n[floor]\nfriction = 0.5\n[gate]\nmotion = \"remove\"\n[end]\ntime = "
      "0.1\n"
      "[output]\nfolder = \"x\"\nsample_interval = 0.01\nsnapshot_interval = 0.1\ngrain_diameter = 0.003\n",
      fit.material_name);
  const auto scene = drivers::read_scene(scene_file);
  const auto wanted = objective.properties(best.best.end);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (i != 11) {
      EXPECT_NEAR(scene.material.properties[i], wanted[i], 1e-5 * std::abs(wanted[i])) << i;
    }
}

TEST(ShippedFiles, FitsAndFittedMaterialsAreRead) {
  int fits = 0, materials = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shipped("fits"))) {
    EXPECT_NO_THROW(read_fit(entry.path().string())) << entry.path();
    ++fits;
  }
  for (const auto& entry : std::filesystem::directory_iterator(shipped("materials"))) {
    EXPECT_NO_THROW(drivers::read_material(
        drivers::parse_toml("file = \"" + entry.path().string() + "\"", "material", "."), 0.6))
        << entry.path();
    ++materials;
  }
  EXPECT_GE(fits, 6);
  EXPECT_GE(materials, 6);
}

TEST(Posterior, GoesOnFromItsFileToTheSameSamples) {
  const auto fit = changed_fit("ss_noise.toml", [](std::string& text) {
    replace(text, "starts = 2", "starts = 1");
    for (std::size_t at; (at = text.find("rows = 60")) != text.npos;) text.replace(at, 9, "rows = 20");
  });
  Objective objective(fit);
  const auto best = least_squares(objective);
  const auto known = identify(objective, best);
  SamplingOptions options;
  options.walkers = 8;
  options.burn_in = 20;
  options.steps = 40;
  const auto whole = sample_posterior(objective, best, known, options);
  const auto file = fit.output_folder + "/chain.h5";
  std::filesystem::remove(file);
  options.steps = 15;
  sample_posterior(objective, best, known, options, {file, false, {}});
  options.steps = 40;
  const auto resumed = sample_posterior(objective, best, known, options, {file, true, {}});
  EXPECT_EQ(resumed.chain.samples, whole.chain.samples);
  // Another data set is another problem.
  auto other = fit;
  other.tests[0].curves[0].values[3] += 1;
  Objective changed(other);
  EXPECT_THROW(sample_posterior(changed, best, known, options, {file, true, {}}), std::runtime_error);
}

// Small here; the large one is `simsand calibrate data/fits/ss_noise.toml --coverage 50` (calibration/README.md).
TEST(Coverage, CountsIntervalsThatHoldTheTruth) {
  const auto fit = changed_fit("ss_noise.toml", [](std::string& text) {
    for (const char* free : {"k_p", "A_d", "n_d", "n_p"}) { // two are left
      const auto from = text.find(std::string("[parameter.") + free);
      ASSERT_NE(from, text.npos);
      text.erase(from, text.find("\n\n", from) - from);
    }
    for (const char* gone : {"dense 5 kPa", "loose 5 kPa", "dense 2 kPa", "loose 2 kPa"}) {
      const auto from = text.rfind("[[test]]", text.find(gone));
      text.erase(from, text.find("\n\n", from) - from);
    }
    for (std::size_t at; (at = text.find("rows = 60")) != text.npos;) text.replace(at, 9, "rows = 30");
    replace(text, "walkers = 32", "walkers = 12");
    replace(text, "coverage_burn_in = 100", "coverage_burn_in = 40");
    replace(text, "coverage_steps = 120", "coverage_steps = 40");
    replace(text, "starts = 2", "starts = 1");
  });
  ASSERT_EQ(fit.parameters(), 2);
  const auto coverage = study_coverage(fit, 8);
  // A study that goes on from its file makes the same sets, and no other fit goes on from it.
  Coverage part = coverage;
  part.sets.resize(3);
  part.sets[1].clear();
  const auto file = fit.output_folder + "/coverage.csv";
  std::ofstream(file) << coverage_csv(fit, part);
  const auto resumed = study_coverage(fit, 3, read_coverage(fit, file));
  EXPECT_EQ(resumed.sets[1][0].lower, coverage.sets[1][0].lower);
  EXPECT_NEAR(resumed.sets[2][1].upper, coverage.sets[2][1].upper, 1e-7);
  auto other = fit;
  other.resolved += "#";
  EXPECT_THROW(read_coverage(other, file), std::runtime_error);
  EXPECT_GE(coverage.overall(), 0.65); // 16 intervals of 90 %: fewer than 11 hold it once in 1500 times
  std::set<double> different;
  for (const auto& set : coverage.sets) {
    different.insert(set[0].best);
    EXPECT_LT(set[0].upper - set[0].lower, 0.5); // degrees
    EXPECT_GT(set[0].upper - set[0].lower, 0.01);
  }
  EXPECT_EQ(different.size(), 8u);
}

} // namespace
