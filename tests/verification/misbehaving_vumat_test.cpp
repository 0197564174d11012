// SPDX-License-Identifier: BSD-3-Clause
// A Fortran VUMAT that breaks one rule after the other, in both hosts: no crash, no silent harm, one clear error;
// or no effect at all where the host can bear it.
#include "tests/verification/vumat_program.hpp"
#include <H5Cpp.h>
#include <algorithm>

namespace {

using namespace tests;

/// misbehaves.f with rule `kind` broken after `time`.
std::string breaking(int kind, double time = 0.005, const std::string& extra = "", int states = 1) {
  return material("misbehaves", fmt::format("[{}, {}, 2e6, 0.25]", kind, time), states, extra);
}

const std::string shear =
    "[[stage]]\ncontrol = \"simple-shear-undrained\"\nshear_strain = 0.01\nincrements = 10\n";

/// One line on standard error with these parts, status not 0, and a readable result of what came before.
void expect_stopped(const Outcome& outcome, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const auto& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << "'" << part << "' in\n" << outcome.err;
}

void expect_readable_result(int samples = 3) {
  const H5::H5File file((folder() / "results/result.h5").string(), H5F_ACC_RDONLY);
  if (samples == 0) return;
  const auto times = file.openDataSet("/series/time");
  EXPECT_GE(times.getSpace().getSimpleExtentNpoints(), samples);
}

void expect_stopped_everywhere(int kind, const std::vector<std::string>& parts) {
  expect_stopped(run_scene(breaking(kind)), parts);
  expect_readable_result();
  expect_stopped(run_scene(breaking(kind), "axisymmetric", 3), parts);
  expect_stopped(run_path(breaking(kind, 0.35), shear), parts);
}

TEST(Misbehaving, NotAtAll) {
  const auto outcome = run_scene(breaking(0));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST(Misbehaving, WritesBeyondArrays) {
  expect_stopped_everywhere(1, {"material misbehaves: its subroutine wrote beyond the end of stateNew"});
  expect_stopped_everywhere(2, {"wrote beyond the end of stressNew"});
  expect_stopped_everywhere(3, {"wrote before the start of stressNew"});
  expect_stopped_everywhere(4, {"wrote beyond the end of strainInc"});
  expect_stopped_everywhere(21, {"wrote before the start of jInfoArray"});
  expect_stopped_everywhere(22, {"wrote beyond the end of jInfoArray"});
}

TEST(Misbehaving, WritesToInputs) {
  expect_stopped_everywhere(5, {"material misbehaves: its subroutine wrote to strainInc, which is an input"});
  expect_stopped_everywhere(6, {"wrote to stressOld, which is an input"});
  expect_stopped_everywhere(7, {"wrote to props, which is an input"});
  for (const int kind : {5, 6, 7}) {
    EXPECT_EQ(run_scene(breaking(kind, 0.005, "may_write_inputs = true")).status, 0);
    EXPECT_EQ(run_path(breaking(kind, 0.35, "may_write_inputs = true"), shear).out,
              run_path(breaking(0), shear).out);
  }
}

TEST(Misbehaving, OverwritesScalarsOrLeavesOutputsToTheHost) {
  ASSERT_EQ(run_scene(breaking(0)).status, 0);
  const auto position = last("position"), stress = last("stress");
  for (const int kind : {8, 10}) {
    const auto outcome = run_scene(breaking(kind));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(last("position"), position);
    EXPECT_EQ(last("stress"), stress);
  }
  EXPECT_EQ(run_path(breaking(8, 0.35), shear).out, run_path(breaking(0), shear).out);
}

TEST(Misbehaving, LeavesStressUnwritten) {
  const auto outcome = run_scene(breaking(9));
  expect_stopped(outcome,
                 {"material misbehaves did not write component 1 of stressNew: particle ", "at time 0.005"});
  expect_stopped(run_path(breaking(9, 0.35), shear), {"did not write component 1 of stressNew: at time"});
}

TEST(Misbehaving, IsToldItsElements) {
  for (const auto* kinematics : {"green-naghdi", "jaumann"}) {
    const auto extra = fmt::format("kinematics = \"{}\"", kinematics);
    ASSERT_EQ(run_scene(breaking(23, 0.0, extra), "plane_strain", 2).status, 0);
    auto numbers = last("state_1");
    std::sort(numbers.begin(), numbers.end());
    ASSERT_EQ(numbers.size(), 100);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(numbers[i], i + 1);
  }
}

TEST(Misbehaving, ReturnsNaN) {
  expect_stopped(run_scene(breaking(11)),
                 {"returned a number that is not finite, component 1 of stressNew: particle ",
                  "at time 0.005", "stress before (", "strain increment (",
                  "(replay: simsand element results/failed_point.toml)"});
  expect_readable_result();
  // The file that was written does the same again, to the last digit of the inputs.
  const auto file = content(folder() / "results/failed_point.toml");
  EXPECT_NE(file.find("# material misbehaves returned a number"), std::string::npos);
  const auto again = simsand("element results/failed_point.toml");
  expect_stopped(again,
                 {"simsand element: results/failed_point.toml: material misbehaves returned a number that is "
                  "not finite, component 1 of stressNew: at time 0.005"});
  EXPECT_EQ(again.out.substr(0, 27), "quantity,component,old,new\n");
  // And answers as it should before the time from which the subroutine fails.
  auto mended = file;
  const auto at = mended.find("0.005", mended.find("properties"));
  mended.replace(at, 5, "100.0");
  std::ofstream(folder() / "mended.toml") << mended;
  const auto good = simsand("element mended.toml");
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_EQ(good.out.find("nan"), std::string::npos);
  // In the data check, before anything else.
  expect_stopped(run_scene(breaking(18, -1)),
                 {"not finite", "from words beyond an array", "at time 0 s", "failed_point.toml"});
}

TEST(Misbehaving, ReplaysWithInputsThatItMayWrite) {
  expect_stopped(run_scene(breaking(24, 0.005, "may_write_inputs = true\nserial = true")),
                 {"returned a number that is not finite, component 1 of stressNew: particle "});
  const auto file = content(folder() / "results/failed_point.toml");
  EXPECT_NE(file.find("may_write_inputs = true\n"), std::string::npos);
  EXPECT_NE(file.find("serial = true\n"), std::string::npos);
  expect_stopped(simsand("element results/failed_point.toml"),
                 {"returned a number that is not finite, component 1 of stressNew: at time 0.005"});
}

/// The element driver tells as much as a run, and leaves the call to be made again.
void expect_evidence(int kind, const std::string& stages, const std::string& fault) {
  const auto found = "material misbehaves " + fault + ": at time 0."; // from 0.35 on, with or without cuts
  const auto file = folder() / "failed_point.toml";
  std::filesystem::remove(file);
  expect_stopped(run_path(breaking(kind, 0.35), stages),
                 {"simsand element: path.toml:", "stage 1 '1', step 4 of 10: " + found, "stress before (",
                  "strain increment (", "(replay: simsand element failed_point.toml); "});
  const auto again = simsand("element failed_point.toml");
  expect_stopped(again, {"failed_point.toml: " + found});
  EXPECT_NE(again.out.find("nan"), std::string::npos);
}

TEST(Misbehaving, ReturnsNaNToTheElementDriver) {
  const std::string nan = "returned a number that is not finite, ",
                    motion = "[[stage]]\ncontrol = \"deformation-gradient\"\n"
                             "gradient = [1, 0.1, 0, 0, 1, 0, 0, 0, 1]\nincrements = 10\n";
  for (const auto& stages : {shear, motion}) {
    expect_evidence(11, stages, nan + "component 1 of stressNew");
    expect_evidence(19, stages, nan + "variable 1 of stateNew");
    expect_evidence(20, stages, nan + "enerInelasNew");
  }
  expect_stopped(run_path(breaking(18, -1), shear),
                 {"stage 1 '1', step 0",
                  "no elastic stiffness from the data check; material misbehaves " + nan, "at time 0 s",
                  "(replay: simsand element failed_point.toml)"});
}

TEST(Misbehaving, LeavesAReproducerBesideEachTable) {
  std::filesystem::remove_all(folder() / "tables");
  const auto stages = shear + "[[stage]]\ncontrol = \"envelope\"\nstrain_norm = 1e-4\nincrements = 3\n";
  for (const auto& [name, time] : {std::pair{"early", 0.35}, {"late", 1.1}, {"never", 100.0}}) {
    std::ofstream(folder() / (std::string(name) + ".toml"))
        << breaking(19, time) << "[initial]\nmean_stress = 0.0\n"
        << stages;
  }
  const auto outcome = simsand("element early.toml late.toml never.toml -t 2 -o tables");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
  EXPECT_NE(outcome.err.find("(replay: simsand element tables/early_failed_point.toml)"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("stage 2 '2', direction 355 degrees: material misbehaves returned"),
            std::string::npos)
      << outcome.err;
  expect_stopped(simsand("element tables/late_failed_point.toml"), {"variable 1 of stateNew"});
  EXPECT_FALSE(std::filesystem::exists(folder() / "tables/never_failed_point.toml"));
}

TEST(Misbehaving, IsLoadedByTheChartsToo) {
  // Its xplb_exit is found; the chart then refuses a material that is not SIMSAND.
  run_scene(breaking(0));
  expect_stopped(simsand("increments scene.toml -o chart", "simsand-chart"),
                 {"the increments of SIMSAND alone can be charted"});
}

TEST(Misbehaving, AReproducerWithUnknownOrMissingKeysIsRefused) {
  run_scene(breaking(11));
  const auto file = content(folder() / "results/failed_point.toml");
  const auto with = [&](const std::string& old, const std::string& now) {
    auto text = file;
    text.replace(text.find(old), old.size(), now);
    std::ofstream(folder() / "changed.toml") << text;
    return simsand("element changed.toml");
  };
  expect_stopped(with("strainInc", "strianInc"), {"changed.toml:", "strainInc"});
  expect_stopped(with("nshr = 1", "nshr = 2"),
                 {"changed.toml:", "key 'call.nshr': expected 1 or 3, found 2"});
  expect_stopped(with("dt = ", "dt = -"), {"changed.toml:", "key 'call.dt'"});
}

TEST(Misbehaving, AsksForTheEnd) {
  expect_stopped_everywhere(
      12, {"material misbehaves: its subroutine asked for the end of the analysis (xplb_exit)"});
  expect_stopped_everywhere(
      14, {"material misbehaves: its subroutine ended the analysis with \"cannot go on after "});
}

TEST(Misbehaving, Stops) {
  // The process ends at once, as by a kill: samples since the last write are lost.
  const auto outcome = run_scene(breaking(15));
  expect_stopped(outcome,
                 {"material misbehaves: its subroutine ended the program (STOP or exit) at time 0.005"});
  expect_readable_result(0);
  expect_stopped(run_scene(breaking(15), "plane_strain", 3, 20), {"ended the program"});
  expect_readable_result(0);
  expect_stopped(run_path(breaking(15, 0.35), shear), {"ended the program"});
}

TEST(Misbehaving, SpeaksThroughAbaqus) {
  auto outcome = run_path(breaking(13, 0.95), shear);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("message of material misbehaves: all is sand\n"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("warning of material misbehaves: 7 of 8 at 2.5\n"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("error of material misbehaves: no arrays: 0\n"), std::string::npos)
      << outcome.err;
  outcome = run_scene(breaking(17, 0.0));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("message of material misbehaves: results in /results, 0 of 1"),
            std::string::npos)
      << outcome.err;
}

TEST(Misbehaving, IsNotThreadSafe) {
  const auto run = [](const std::string& extra, int threads) {
    const auto outcome = run_scene(breaking(16, 0.0195, extra, 2), "plane_strain", threads, 20);
    const auto met = last("state_2");
    return std::pair{outcome.status, *std::max_element(met.begin(), met.end())};
  };
  EXPECT_EQ(run("", 3).second, 1) << "three threads meet in it";
  EXPECT_EQ(run("", 1), (std::pair{0, 0.0}));
  const auto position = last("position"), stress = last("stress");
  EXPECT_EQ(run("serial = true", 3), (std::pair{0, 0.0})) << "not in serial mode";
  EXPECT_EQ(last("position"), position);
  EXPECT_EQ(last("stress"), stress);
}

TEST(Misbehaving, Throws) {
  const auto throwing = [](int what) {
    return material("libthrows", fmt::format("[0.005, 2e6, 0.25, {}]", what), 0);
  };
  expect_stopped(run_scene(throwing(0)),
                 {"material libthrows: its subroutine threw an exception at time 0.005",
                  ": no tangent, in the block of "});
  expect_readable_result();
  expect_stopped(run_scene(throwing(1), "plane_strain", 3),
                 {"its subroutine threw an exception at time 0.005"});
}

TEST(Misbehaving, NeedsWhatNoHostHas) {
  expect_stopped(run_scene(material("libneeds_more", "[1]", 0)),
                 {"scene.toml:", "key 'library'", "undefined symbol: vgetvrm_"});
}

} // namespace
