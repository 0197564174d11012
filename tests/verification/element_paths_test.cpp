// SPDX-License-Identifier: BSD-3-Clause
// Path files as a user runs them: the shipped ones, replays of measured and of own output, several at a time,
// pictures.
#include "drivers/element/command.hpp"
#include "drivers/files/csv_table.hpp"
#include "tests/verification/element_fixture.hpp"
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace element_fixture;
namespace fs = std::filesystem;

namespace {

/// A fresh folder of the running test.
fs::path folder() {
  const auto path =
      fs::path(testing::TempDir()) /
      fmt::format("{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

std::string content(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<std::string> shipped() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(paths))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ElementPaths, EveryShippedPathRunsAndEveryControlIsAmongThem) {
  std::set<std::string> controls;
  bool cyclic = false, replayed = false, critical = false;
  for (const auto& file : shipped()) {
    SCOPED_TRACE(file);
    ElementCase element;
    ASSERT_EQ(error_of([&] { element = read_element_case(read_toml(file)); }), "");
    long rows = 0;
    EXPECT_EQ(error_of([&] {
                run_element_case(element, [&](const ElementRow& r) {
                  ++rows;
                  EXPECT_TRUE(r.point.stress.allFinite());
                });
              }),
              "");
    EXPECT_GT(rows, 10);
    if (content(file).find("\"repeat\"") != std::string::npos) controls.insert("repeat");
    for (const auto& stage : element.stages) {
      controls.insert(stage.control);
      cyclic |= stage.cycling.has_value();
      replayed |= stage.measured.has_value();
      for (const auto& stop : stage.stops) critical |= stop.critical_tolerance > 0;
    }
  }
  for (const auto& name : control_names()) EXPECT_TRUE(controls.contains(name)) << name;
  EXPECT_TRUE(cyclic && replayed && critical);
}

TEST(ElementPaths, RepeatedStagesAreTheSameStagesWrittenOut) {
  const auto load = stage_text("isotropic", "mean_stress = 40e3\nincrements = 10\n"),
             unload = stage_text("isotropic", "mean_stress = 10e3\nincrements = 10\n"),
             repeat = std::string("[[stage]]\ncontrol = 'repeat'\nstages = 2\ntimes = 2\n");
  const auto once = rows_of(path_text("TS", 0.6, 10e3, load + unload + repeat)),
             written = rows_of(path_text("TS", 0.6, 10e3, load + unload + load + unload + load + unload));
  ASSERT_EQ(once.size(), 61u);
  ASSERT_EQ(written.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].point.stress, written[i].point.stress);
    EXPECT_EQ(once[i].stage, written[i].stage);
  }
  EXPECT_EQ(error_of([&] { case_of(path_text("TS", 0.6, 10e3, load + repeat)); }),
            "path.toml:14: key 'stage.stages': expected at most 1, the stages before, found 2");
}

/// A test with cycles, its rows as a table in other units and signs, replayed.
TEST(ElementPaths, AReplayOfOwnOutputReproducesThePath) {
  const auto stages = stage_text("triaxial-drained",
                                 "strain_increment = 2e-4\n[stage.cyclic]\ncycles = 2\n"
                                 "limits = [{quantity = 'axial_strain', lower = -5e-3, upper = 1e-2}]\n") +
                      stage_text("triaxial-constant-p", "axial_strain = 0.05\nstrain_increment = 5e-4");
  const auto measured = rows_of(path_text("TS", 0.55, 10e3, stages));
  const auto file = (folder() / "measured.csv").string();
  {
    std::ofstream out(file);
    out << "# test 1\nt;\"eps\";cell;note\n";
    for (const auto& r : measured)
      out << fmt::format("{:.17g};{:.17g};{:.17g};-\n", r.point.time / 60 + 1, -100 * r.point.strain[0],
                         -1e-3 * r.point.stress[1]);
  }
  const auto again = rows_of(
      path_text("TS", 0.55, 10e3,
                stage_text("axisymmetric",
                           fmt::format("[stage.replay]\nfile = '{}'\ncompression = 'negative'\ncolumns = [\n"
                                       "{{column = 't', quantity = 'time', unit = 'min'}},\n"
                                       "{{column = 'eps', quantity = 'axial_strain', unit = 'percent'}},\n"
                                       "{{column = 'cell', quantity = 'radial_stress', unit = 'kPa'}}]",
                                       file))));
  ASSERT_EQ(again.size(), measured.size() + 1); // the initial state is written before the first row
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const auto &a = again[i + 1], &m = measured[i];
    EXPECT_LT((a.point.stress - m.point.stress).norm(), 1e-6 * m.point.stress.norm()) << i;
    EXPECT_LT((a.point.strain - m.point.strain).norm(), 1e-6 * measured.back().point.strain.norm()) << i;
    EXPECT_NEAR(a.point.state[1], m.point.state[1], 1e-6 * measured.back().point.state[1]) << i;
  }
  EXPECT_NEAR(again.back().point.time, measured.back().point.time + 1.0 / double(measured.size()), 1e-6);
}

TEST(ElementPaths, AReplayFollowsTheMeasuredColumns) {
  const auto element = read_element_case(read_toml(paths + "/replay_triaxial.toml"));
  const auto& replay = *element.stages.front().measured;
  const CsvTable csv(replay.file);
  ASSERT_EQ(replay.rows.size(), csv.rows());
  std::size_t next = 0;
  run_element_case(element, [&](const ElementRow& r) {
    const double strain = csv.number(std::min(next, csv.rows() - 1), csv.column("axial_strain"));
    if (std::abs(r.point.strain[0] - strain) > 1e-12) return; // between two rows
    EXPECT_NEAR(r.point.stress[1], csv.number(next, csv.column("sigma_radial_Pa")), 1e-8 * r.point.stress[1]);
    ++next;
  });
  EXPECT_EQ(next, csv.rows());
}

TEST(ElementPaths, AReplayThatFailsNamesTheRow) {
  const auto file = (folder() / "pulled.csv").string();
  std::ofstream(file) << "s\n10\n-20\n";
  const auto error = error_of([&] {
    rows_of(path_text(
        "TS", 0.55, 10e3,
        stage_text("isotropic", fmt::format("[stage.replay]\nfile = '{}'\ncolumns = [{{column = 's', "
                                            "quantity = 'mean_stress', unit = 'kPa'}}]",
                                            file))));
  });
  EXPECT_TRUE(
      error.starts_with("path.toml:6: stage 1 'shear', step 2, row of " + file + ":3: condition 1 of 6"))
      << error;
}

TEST(ElementPaths, SeveralPathsGiveTheTablesOfEach) {
  const auto at = folder();
  const Words files{paths + "/ss_dense_10kpa.toml", paths + "/envelopes.toml", paths + "/oedometric.toml"};
  ASSERT_EQ(run_elements({files, (at / "all").string(), "", "", "", {}, 2}), 0);
  for (const auto& file : files) {
    const auto name = fs::path(file).stem().string() + ".csv";
    ASSERT_EQ(run_element({file, (at / name).string(), "", ""}), 0);
    EXPECT_EQ(content(at / name), content(at / "all" / name));
  }
  EXPECT_EQ(content(at / "envelopes_envelope.csv"), content(at / "all/envelopes_envelope.csv"));
  const auto probes = content(at / "envelopes_envelope.csv");
  EXPECT_TRUE(probes.starts_with("stage,direction_deg,strain_increment_11,"));
  EXPECT_EQ(std::count(probes.begin(), probes.end(), '\n'), 1 + 3 * 72);
}

TEST(ElementPaths, OneBadPathDoesNotStopTheOthers) {
  const auto at = folder();
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_elements({{"/no/such.toml", paths + "/oedometric.toml"}, at.string(), "", "", "", {}, 2}), 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "simsand element: /no/such.toml: expected a readable TOML file with content, found none\n");
  EXPECT_TRUE(fs::exists(at / "oedometric.csv"));
  const auto message_of = [](const ElementBatch& batch) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_elements(batch), 1);
    return testing::internal::GetCapturedStderr();
  };
  const auto one = paths + "/oedometric.toml", envelope = paths + "/envelopes.toml";
  EXPECT_EQ(message_of({{one, one}, "", "", "", "", {}, 1}),
            "simsand element: several paths need a folder: give -o FOLDER\n");
  EXPECT_EQ(message_of({{one, one}, at.string(), "", "", "", {}, 1}),
            fmt::format("simsand element: {}: a second path named 'oedometric'\n", one));
  EXPECT_EQ(
      message_of({{envelope}, "", "", "", "", {}, 1}),
      fmt::format("simsand element: {}: an envelope stage needs a file: give -o or --envelope\n", envelope));
  EXPECT_EQ(message_of({{one}, "", "", "", "pictures", {}, 1}),
            "simsand element: --figures needs tables in files: give -o\n");
}

TEST(ElementPaths, PicturesAreDrawnWhereMatplotlibIs) {
  if (std::system("/usr/bin/python3 -c 'import matplotlib' 2>/dev/null") != 0)
    GTEST_SKIP() << "no matplotlib";
  const auto at = folder();
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_elements({{paths + "/triaxial_undrained.toml", paths + "/envelopes.toml"},
                          (at / "tables").string(),
                          "",
                          "",
                          (at / "pictures").string(),
                          {},
                          2}),
            0);
  testing::internal::GetCapturedStdout();
  for (const char* name :
       {"overview", "deviator", "volume", "stress_path", "void_ratio", "pore_pressure", "envelopes"})
    EXPECT_GT(content(at / "pictures" / (std::string(name) + ".png")).size(), 10000u) << name;
}

TEST(ElementPaths, WithoutMatplotlibTheErrorSaysSo) {
  const auto at = folder();
  std::ofstream(at / "matplotlib.py") << "raise ImportError('none here')\n";
  const auto command =
      fmt::format("PYTHONPATH='{0}' {1}/simsand element {2}/oedometric.toml -o '{0}/t.csv' --figures "
                  "'{0}/f' 2>'{0}/err'",
                  at.string(), SIMSAND_BINARY_DIR, paths);
  EXPECT_NE(std::system(command.c_str()), 0);
  const auto error = content(at / "err");
  EXPECT_TRUE(
      error.starts_with("element_figures.py: needs numpy and matplotlib (none here): apt-get install "))
      << error;
  EXPECT_NE(error.find("figures were not drawn"), std::string::npos);
  EXPECT_TRUE(fs::exists(at / "t.csv")); // the table is there all the same
}

} // namespace
