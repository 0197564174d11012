// SPDX-License-Identifier: BSD-3-Clause
// The chart of accuracy, runs to a tolerance and over a posterior, as a user calls them, on coarse columns.
#include "drivers/files/csv_table.hpp"
#include "tests/verification/program.hpp"
#include <algorithm>

namespace {

namespace fs = std::filesystem;
using tests::Program;

const std::string data = std::string(SIMSAND_SOURCE_DIR) + "/data";
const std::string coarse = data + "/scenes/ss_dense_a0.5.toml";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

const std::string chart_program = SIMSAND_BINARY_DIR "/simsand-chart";

/// A folder with the quick chart, and a data folder that holds its table.
const Program& chart() {
  static const Program program("accuracy_chart");
  static const auto outcome = program.shell(chart_program + " accuracy --quick -o chart -j 2");
  static const bool done = [] {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "14 runs, 14 of them to do")) << outcome.err;
    fs::create_directories(program.folder / "data/accuracy");
    fs::copy(program.folder / "chart/runs.csv", program.folder / "data/accuracy/runs.csv");
    return true;
  }();
  EXPECT_TRUE(done);
  return program;
}

TEST(AccuracyChart, WritesItsTablesAndPicturesAndResumes) {
  const auto& program = chart();
  const drivers::CsvTable runs((program.folder / "chart/runs.csv").string());
  ASSERT_EQ(runs.rows(), 14u);
  for (std::size_t k = 0; k < runs.rows(); ++k) {
    EXPECT_EQ(runs.number(k, runs.column("failed")), 0);
    EXPECT_GT(runs.number(k, runs.column("seconds")), 0);
    EXPECT_LT(runs.number(k, runs.column("outline_error")), 0.3);
    EXPECT_LT(std::abs(runs.number(k, runs.column("dem_radius_error"))), 0.5);
  }
  const drivers::CsvTable points((program.folder / "chart/points.csv").string());
  EXPECT_EQ(points.rows(), 5u);
  for (const char* picture : {"finest", "dem", "scatter"})
    EXPECT_GT(fs::file_size(program.folder / fmt::format("chart/accuracy_{}.png", picture)), 10000u);
  const auto again = program.shell(chart_program + " accuracy --quick -o chart");
  EXPECT_TRUE(has(again.err, "14 runs, 0 of them to do")) << again.err;
}

TEST(ToleranceRun, ChoosesRunsAndEstimates) {
  const auto& program = chart();
  const auto command = fmt::format("run '{}' --tolerance 10% --data data -o tolerance -q", coarse);
  const auto outcome = program.run(command);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "tolerance 10 %: 2 of 4 charted configurations meet it")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "stiffness scale 0.1, 8 particles a side")) << outcome.err;
  EXPECT_TRUE(
      has(outcome.out, "each judged by the other columns, such intervals hold the finest run in 80 %"))
      << outcome.out;
  const drivers::CsvTable table((program.folder / "tolerance/accuracy.csv").string());
  ASSERT_EQ(table.rows(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto number = [&](const char* name) { return table.number(k, table.column(name)); };
    EXPECT_NEAR(number("upper") - number("value"), number("half_width") * number("value"), 1e-3);
    const double difference = number("companion") / number("value") - 1;
    EXPECT_GE(number("half_width"), 0.999 * std::hypot(number("chart_error"), difference));
  }
  const auto result = program.folder / "tolerance/result.h5";
  const auto written = fs::last_write_time(result);
  EXPECT_EQ(program.run(command).status, 0);
  EXPECT_EQ(fs::last_write_time(result), written) << "a complete run was run again";
}

TEST(ToleranceRun, AThreeDimensionalSceneRunsInAxisymmetry) {
  const auto& program = chart();
  const auto outcome = program.run(
      fmt::format("run '{}/scenes/ts_dense_a1_quarter.toml' --tolerance 12% --data data -o solid -q", data));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(program.content("solid/scene.toml"), "geometry = \"axisymmetric\""));
}

TEST(ToleranceRun, RefusesWhatConflicts) {
  const auto& program = chart();
  const auto refused = [&](const std::string& words, const std::string& message) {
    const auto outcome = program.run("run " + words + " --data data -o refused -q");
    EXPECT_EQ(outcome.status, 1) << words;
    EXPECT_TRUE(has(outcome.err, message)) << words << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused(coarse + " --tolerance 1%", "the best is");
  refused(coarse + " --tolerance 5", "expected a share above 0");
  refused(data + "/scenes/channel.toml --tolerance 20%", "no configuration for this flow");
  refused(data + "/scenes/chute.toml --tolerance 20%",
          "key 'wall': expected [floor] and [gate] beside --tolerance");
  refused(coarse + " --tolerance 12% --set scene.spacing=0.002",
          "--set scene.spacing=0.002: expected no such key");
  refused(coarse + " --tolerance 12% --set numerics.viscosity=0.1",
          "key 'numerics.viscosity': expected the default 0.05");
  refused(coarse + " --tolerance 12% --set numerics.kernel=wendland-c4",
          "--set numerics.kernel=wendland-c4: expected no such key");
  const auto read = [](const std::string& path) { return std::ifstream(path); };
  std::stringstream text;
  text << read(coarse).rdbuf();
  auto scene = text.str();
  const std::string file = "file = \"../materials/SS.toml\"";
  ASSERT_TRUE(has(scene, file));
  scene.replace(scene.find(file), file.size(),
                "file = \"" + data + "/materials/SS.toml\"\nstiffness_scale = 0.5");
  program.write("soft.toml", scene);
  refused("soft.toml --tolerance 12%",
          "key 'material.stiffness_scale': expected no such key beside --tolerance");
  scene.replace(scene.find("stiffness_scale = 0.5"), 21, "");
  program.write("kernel.toml", scene + "\n[numerics]\nkernel = \"wendland-c4\"\n");
  refused("kernel.toml --tolerance 12%", "key 'numerics.kernel': expected the default beside --tolerance");
}

/// A fit of two parameters to one made test, with a short chain.
std::string fit_text() {
  return "title = \"short\"\n[material]\nfile = \"" + data +
         "/materials/SS.toml\"\n[parameter.phi]\nlower = 14\nupper = 26\n[parameter.A_d]\nlower = 0.3\nupper "
         "= 3\n"
         "[[test]]\nname = \"dense\"\nkind = \"triaxial-drained\"\nconfining_stress = 10e3\nvoid_ratio = "
         "0.58\n"
         "axial_strain = 0.2\nrows = 20\ncompare = [\"deviatoric_stress\", \"volumetric_strain\"]\n"
         "[error.deviatoric_stress]\nof_peak = 0.05\n[error.volumetric_strain]\nof_peak = 0.1\n"
         "[synthetic]\nnoise = 1.0\n[search]\nstarts = 1\n[sampling]\nwalkers = 8\nburn_in = 60\nsteps = "
         "40\n";
}

TEST(Posterior, GivesBandsOfTheDeposit) {
  const Program program("accuracy_posterior");
  program.write("fit.toml", fit_text());
  ASSERT_EQ(program.run("calibrate fit.toml -q -o fit").status, 0) << program.content("err");
  const auto words = "run '" + coarse + "' --posterior fit/fit.h5 --set scene.spacing=0.006 -q -j 2 -o bands";
  const auto outcome = program.run(words + " -n 6 --seed 3");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "6 of 6 sets ran to the end")) << outcome.out;
  const drivers::CsvTable sets((program.folder / "bands/sets.csv").string());
  ASSERT_EQ(sets.rows(), 6u);
  const auto phi = sets.numbers("phi");
  EXPECT_GT(*std::max_element(phi.begin(), phi.end()) - *std::min_element(phi.begin(), phi.end()), 0.1);
  EXPECT_NEAR(phi[0], 18.5, 4);
  const drivers::CsvTable bands((program.folder / "bands/bands.csv").string());
  ASSERT_EQ(bands.rows(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto number = [&](const char* name) { return bands.number(k, bands.column(name)); };
    EXPECT_LT(number("lower_5"), number("median"));
    EXPECT_LT(number("median"), number("upper_95"));
  }
  for (const char* name : {"outline_bands", "height_bands"}) {
    const drivers::CsvTable curve((program.folder / fmt::format("bands/{}.csv", name)).string());
    EXPECT_NEAR(curve.number(0, curve.column("median")), 0.02, 0.008)
        << name; // near the initial 25 mm and below
  }
  EXPECT_TRUE(fs::exists(program.folder / "bands/posterior.png"));
  // The same seed draws the same sets, all of which are there: nothing is run again.
  const auto table = program.content("bands/sets.csv");
  const auto written = fs::last_write_time(program.folder / "bands/sets/001/result.h5");
  const auto again = program.run(words + " -n 6 --seed 3");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(fs::last_write_time(program.folder / "bands/sets/001/result.h5"), written);
  EXPECT_EQ(program.content("bands/sets.csv"), table);
}

TEST(Posterior, AFailedSetIsNamedAndLeftOut) {
  const Program program("accuracy_posterior_failure");
  program.write("fit.toml", fit_text());
  ASSERT_EQ(program.run("calibrate fit.toml -q -o fit").status, 0) << program.content("err");
  fs::create_directories(program.folder / "bands/sets/002/result.h5/held"); // where the result should be
  const auto outcome = program.run(
      "run '" + coarse + "' --posterior fit/fit.h5 --set scene.spacing=0.008 -q -j 1 -o bands -n 3");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "002")) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "2 of 3 sets ran to the end, the others failed")) << outcome.out;
  EXPECT_TRUE(has(program.content("bands/sets.csv"), "\n002,"));
}

TEST(Posterior, RefusesWhatDoesNotFit) {
  const Program program("accuracy_posterior_refused");
  program.write("fit.toml", fit_text());
  ASSERT_EQ(program.run("calibrate fit.toml -q -o fit").status, 0) << program.content("err");
  const auto refused = [&](const std::string& words, const std::string& message) {
    const auto outcome = program.run("run " + words + " -n 4 -q -o refused");
    EXPECT_NE(outcome.status, 0) << words;
    EXPECT_TRUE(has(outcome.err, message)) << words << ": " << outcome.err;
  };
  refused(coarse + " --set material.lambda=0.05 --posterior fit/fit.h5", "for lambda = 0.04, which");
  refused(coarse + " --posterior fit/chain.h5", "found its chain, which holds coordinates");
  refused(coarse + " --posterior none.h5", "none.h5: no such file");
  refused(coarse + " --posterior fit.toml", "not a result of simsand calibrate");
  refused(coarse + " --posterior fit/fit.h5 --tolerance 5%", "excludes");
  const auto simple = "'" + coarse + "' --set material.file=" + data + "/materials/drucker_prager_24.toml" +
                      " --set initial_stress.K0=0.6 --posterior fit/fit.h5";
  refused(simple, "expected a scene whose material is SIMSAND");
  EXPECT_NE(program.run("run '" + coarse + "' --posterior fit/fit.h5 -n 100000 -q -o refused").status, 0);
  EXPECT_TRUE(has(program.content("err"), "expected at least 100000 samples, found 320"))
      << program.content("err");
  ASSERT_EQ(program.run("calibrate fit.toml -q -o best --best-only").status, 0);
  refused(coarse + " --posterior best/fit.h5", "expected a posterior, found a fit without one");
}

} // namespace
