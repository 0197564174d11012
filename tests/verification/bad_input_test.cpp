// SPDX-License-Identifier: BSD-3-Clause
// The program, given what it must refuse: one clear line on standard error, a non-zero status, and
// whatever was computed until then on disk.
#include <H5Cpp.h>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int status;
  std::string out, err;
};

std::string content(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A fresh folder of the running test; the program runs in it.
fs::path folder() {
  const auto path =
      fs::absolute("bad_input_results") / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(path);
  return path;
}

Outcome simsand(const std::string& arguments) {
  const auto at = folder();
  const auto command = fmt::format("cd '{}' && exec timeout 100 '{}/simsand' {} >out 2>err", at.string(),
                                   SIMSAND_BINARY_DIR, arguments);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(at / "out"), content(at / "err")};
}

/// Fails unless the program said `line` and nothing else, and did not exit with 0.
void expect_line(const Outcome& outcome, const std::string& line) {
  EXPECT_NE(outcome.status, 0);
  EXPECT_EQ(outcome.err, line + "\n");
}

/// The same, for lines of which only parts are known.
void expect_parts(const Outcome& outcome, const std::vector<std::string>& parts) {
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.status, 124) << "hangs";
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const auto& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << "'" << part << "' in\n" << outcome.err;
}

/// A small scene of a few milliseconds of an elastic block.
std::string scene() {
  return fmt::format(R"([scene]
geometry = "plane_strain"
spacing = 0.01
[column]
radius = 0.05
height = 0.05
[material]
library = "{}/test_vumats/libelastic.so"
name = "elastic"
properties = [1e6, 0.3]
state_variables = 1
density = 1500.0
[initial_stress]
K0 = 0.5
[floor]
friction = 0.5
[gate]
motion = "lift"
speed = 1.6
[end]
time = 0.02
[output]
folder = "results"
sample_interval = 0.002
snapshot_interval = 0.004
grain_diameter = 0.003
)",
                     SIMSAND_BINARY_DIR);
}

/// `text` with one occurrence of `old` replaced.
std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), replacement);
}

Outcome run(const std::string& text, const std::string& options = "") {
  std::ofstream(folder() / "scene.toml") << text;
  return simsand("run --quiet --threads 1 " + options + " scene.toml");
}

TEST(BadInput, AForeignMaterialInAFileHasNoPressureAtRest) {
  const auto whole = scene();
  const auto start = whole.find("library"), end = whole.find("[initial_stress]");
  std::ofstream(folder() / "material.toml") << whole.substr(start, end - start);
  const auto text = whole.substr(0, start) + "file = \"material.toml\"\n" + whole.substr(end);
  EXPECT_EQ(run(text).status, 0);
  expect_parts(run(with(text, "[initial_stress]\nK0 = 0.5\n", "")),
               {"key 'initial_stress.K0': expected a number from 0 to 10, found no such key"});
}

TEST(BadInput, TheSceneItselfRuns) {
  const auto outcome = run(scene());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST(BadInput, Keys) {
  const auto refuses = [](const std::string& old, const std::string& replacement, const std::string& line) {
    expect_line(run(with(scene(), old, replacement)), "simsand: scene.toml:" + line);
  };
  refuses("spacing = 0.01", "spacing = 0.01\ngravty = 9.81",
          "4: key 'scene.gravty': expected a known key such as 'gravity', found an unknown one");
  refuses("[floor]", "[flor]\n[floor]",
          "15: key 'flor': expected a known key such as 'floor', found an unknown one");
  refuses(
      "spacing = 0.01\n", "",
      "1: key 'scene.spacing': expected a number from 1e-06 to 1000, found no such key in table 'scene' of "
      "line 1");
  refuses("[end]\ntime = 0.02\n", "", "1: key 'end': expected a table, found no such table");
  refuses("speed = 1.6\n", "",
          "17: key 'gate.speed': expected a number above 0, found no such key in table 'gate' of line 17");
  refuses("height = 0.05", "radius = 0.05", "6: key 'radius': expected one definition, found a second");
  refuses("[floor]", "[column]", "15: table 'column': expected one definition, found a second");
  refuses("spacing = 0.01", "spacing = -0.01",
          "3: key 'scene.spacing': expected a number from 1e-06 to 1000, found -0.01");
  refuses("time = 0.02", "time = 0", "21: key 'end.time': expected a number above 0, found 0");
  refuses("time = 0.02", "time = nan", "21: key 'end.time': expected a number above 0, found nan");
  refuses("friction = 0.5", "friction = \"rough\"",
          "16: key 'floor.friction': expected a number from 0 to 10 or \"no-slip\", found \"rough\"");
  refuses("\"lift\"", "\"left\"",
          "18: key 'gate.motion': expected one of \"lift\", \"remove\", \"fixed\", found \"left\"");
  refuses("[1e6, 0.3]", "[1e6, \"a\"]",
          "10: key 'material.properties': expected an array of numbers, found element 2: \"a\"");
  refuses("state_variables = 1", "state_variables = 1.5",
          "11: key 'material.state_variables': expected an integer from 0 to 10000, found 1.5");
  refuses("density = 1500.0", "density = 1500.0\nstiffness_scale = 0.1",
          "13: key 'material.stiffness_scale': expected a material that is SIMSAND, found one with PROPS of "
          "its own");
  refuses("folder = \"results\"", "folder = 3", "23: key 'output.folder': expected a text, found 3");
  refuses("spacing = 0.01", "sector = \"full\"\nspacing = 0.01",
          "3: key 'scene.sector': expected a known key, found an unknown one");
  refuses(
      "plane_strain", "three_dimensional",
      "1: key 'scene.sector': expected one of \"full\", \"half\", \"quarter\", found no such key in table "
      "'scene' of line 1");
  const auto number_for_table =
      with(with(scene(), "[floor]\nfriction = 0.5\n", ""), "[scene]", "floor = 3\n[scene]");
  expect_line(run(number_for_table), "simsand: scene.toml:1: key 'floor': expected a table, found 3");
}

TEST(BadInput, FilesThatAreNoScene) {
  expect_parts(run("[scene\n"), {"simsand: scene.toml:1: expected valid TOML, found an error: "});
  expect_parts(run("[scene]\nspacing = = 1\n"), {"scene.toml:2: expected valid TOML"});
  expect_parts(run(""), {"simsand: scene.toml: expected a readable TOML file with content, found none"});
  expect_parts(simsand("run nowhere.toml"), {"simsand: nowhere.toml: expected a readable TOML file"});
  expect_parts(simsand("run ."), {"simsand: .: expected a readable TOML file"});
  expect_parts(simsand("run nowhere.h5"), {"nowhere.h5: no such file"});
  std::ofstream(folder() / "text.h5") << "no result";
  expect_parts(simsand("run text.h5"), {"text.h5: not a readable result"});
}

TEST(BadInput, ScenesWithoutParticles) {
  expect_parts(
      run(with(scene(), "radius = 0.05", "radius = 0.004")),
      {"simsand: scene without particles: a column of 0.004 m x 0.05 m holds none at a spacing of 0.01 m"});
  expect_parts(run(with(scene(), "height = 0.05", "height = 0.004")), {"scene without particles"});
}

TEST(BadInput, ThreeDimensionsNeedParticlesAcrossTheRadius) {
  const auto quarter = [](const std::string& spacing) {
    return with(with(scene(), "\"plane_strain\"", "\"three_dimensional\"\nsector = \"quarter\""),
                "spacing = 0.01", "spacing = " + spacing);
  };
  EXPECT_EQ(run(quarter("0.01")).status, 0);
  expect_parts(run(quarter("0.02")),
               {"simsand: too few particles across the radius for three dimensions: a column "
                "of 0.05 m x 0.05 m at a spacing of 0.02 m"});
}

TEST(BadInput, MoreParticlesThanCanBeNumbered) {
  expect_parts(run(with(scene(), "spacing = 0.01", "spacing = 1e-6")), {"spacing", "particles"});
}

TEST(BadInput, OutputFoldersThatCannotBe) {
  std::ofstream(folder() / "file") << "a file";
  expect_parts(run(scene(), "-o file/below"), {"file/below", "cannot create the output folder"});
  expect_parts(run(with(scene(), "\"results\"", "\"file\"")), {"simsand: file"});
  expect_parts(run(scene(), "-o /proc/nowhere"), {"/proc/nowhere", "cannot create the output folder"});
}

TEST(BadInput, Libraries) {
  const auto other = [](const std::string& name) { return with(scene(), "libelastic.so", name); };
  expect_parts(run(other("libno_symbol.so")), {"simsand: scene.toml:8: key 'library': material library ",
                                               "libno_symbol.so: exports no vumat_"});
  expect_parts(run(other("libnowhere.so")),
               {"simsand: scene.toml:8: key 'library': material library ", "libnowhere.so"});
  std::ofstream(folder() / "text.so") << "no library";
  const std::string shipped = fmt::format("\"{}/test_vumats/libelastic.so\"", SIMSAND_BINARY_DIR);
  expect_parts(run(with(scene(), shipped, "\"text.so\"")), {"scene.toml:8: key 'library'", "text.so"});
}

std::string nan_scene(double after) {
  return with(with(scene(), "libelastic.so", "libnan_after.so"), "[1e6, 0.3]",
              fmt::format("[{:.4f}, 1e6, 0.3]", after));
}

/// Values of a dataset.
std::vector<double> read(const H5::H5File& file, const std::string& name) {
  const auto dataset = file.openDataSet(name);
  std::vector<double> values(dataset.getSpace().getSimpleExtentNpoints());
  dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE);
  return values;
}

TEST(BadInput, AMaterialThatReturnsNaNLeavesAReadableResult) {
  fs::remove_all(folder() / "results");
  expect_parts(run(nan_scene(0.01)), {"simsand: material elastic", "not finite", "particle ", "at time 0.01",
                                      "stress before (", "Pa", "strain increment ("});
  const H5::H5File file((folder() / "results/result.h5").string(), H5F_ACC_RDONLY);
  int complete = -1;
  file.openAttribute("complete").read(H5::PredType::NATIVE_INT, &complete);
  EXPECT_EQ(complete, 0);
  const auto times = read(file, "/series/time");
  ASSERT_GE(times.size(), 5);
  EXPECT_EQ(times.front(), 0);
  EXPECT_NEAR(times.back(), 0.01, 0.002);
  const auto snapshots = file.openGroup("/snapshots").getNumObjs();
  ASSERT_GE(snapshots, 4) << "at 0, 4 and 8 ms and at the end";
  for (unsigned s = 0; s < snapshots; ++s)
    for (const auto* field : {"position", "velocity", "stress", "density"})
      for (const double v : read(file, fmt::format("/snapshots/{:04}/{}", s, field)))
        EXPECT_TRUE(std::isfinite(v));
  EXPECT_EQ(read(file, "/snapshots/0000/stress").size(), 25 * 4);
  EXPECT_TRUE(fs::exists(folder() / "results/result.xdmf"));
}

TEST(BadInput, AMaterialThatReturnsNaNAtOnceIsNamed) {
  expect_parts(run(nan_scene(-1)), {"material elastic", "not finite", "particle ", "time 0 s"});
}

TEST(BadInput, ElementPaths) {
  const std::string path = fmt::format(R"([material]
library = "{}/test_vumats/libelastic.so"
name = "elastic"
properties = [1e6, 0.3]
state_variables = 1
density = 1500.0
[initial]
mean_stress = 1e3
[[stage]]
control = "triaxial-drained"
axial_strain = 0.01
increments = 10
)",
                                       SIMSAND_BINARY_DIR);
  const auto element = [](const std::string& text, const std::string& options = "") {
    std::ofstream(folder() / "path.toml") << text;
    return simsand("element path.toml " + options);
  };
  EXPECT_EQ(element(path).status, 0);
  EXPECT_EQ(simsand("element path.toml").err, "");
  expect_line(
      element(with(path, "mean_stress = 1e3", "mean_stress = 1e3\nporosity = 0.4")),
      "simsand element: path.toml:9: key 'initial.porosity': expected a known key, found an unknown one");
  expect_parts(element(with(path, "triaxial-drained", "triaxial")),
               {"path.toml:10: key 'stage.control': expected"});
  expect_parts(element(with(path, "axial_strain = 0.01", "axial_strain = \"x\"")),
               {"path.toml:11: key 'stage.axial_strain': expected a number", "found \"x\""});
  expect_parts(element(path.substr(0, path.find("[[stage]]"))), {"path.toml:1: key 'stage': expected"});
  expect_parts(element(with(path, "[initial]", "[initial")), {"path.toml:7: expected valid TOML"});
  expect_parts(element(with(path, "libelastic", "libno_symbol")),
               {"path.toml:2: key 'library'", "no vumat_"});
  expect_parts(element(path, "-o /proc/nowhere/out.csv"), {"/proc/nowhere/out.csv: cannot be written"});
  expect_parts(simsand("element nowhere.toml"),
               {"simsand element: nowhere.toml: expected a readable TOML file"});
  const auto broken = with(with(path, "libelastic", "libnan_after"), "[1e6, 0.3]", "[0.35, 1e6, 0.3]");
  const auto outcome = element(broken);
  expect_parts(outcome, {"path.toml:9: stage 1", "step 4 of 10", "not finite"});
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1 + 1 + 3 + 1)
      << "header, start, three increments, the last state that converged";
}

TEST(BadInput, HelpIsHelp) {
  for (const auto* arguments : {"--help", "run --help", "element --help", "--version"}) {
    const auto outcome = simsand(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_NE(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(BadInput, CommandLines) {
  expect_parts(simsand(""), {"ubcommand"});
  expect_parts(simsand("run"), {"SCENE"});
  expect_parts(simsand("element"), {"PATH"});
  expect_parts(simsand("collapse"), {"unknown command 'collapse'"});
  expect_parts(simsand("run --threads 0 scene.toml"), {"--threads"});
  expect_parts(simsand("run --fast scene.toml"), {"--fast"});
}

} // namespace
