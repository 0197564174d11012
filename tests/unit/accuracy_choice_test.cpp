// SPDX-License-Identifier: BSD-3-Clause
// The choice to a tolerance and its interval, on tables whose answers are known.
#include "drivers/tolerance/choice.hpp"
#include "drivers/tolerance/deposit.hpp"
#include "drivers/tolerance/tolerance_run.hpp"
#include "drivers/tolerance/tolerance_scene.hpp"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

using namespace drivers;

/// A run whose h_f and r_f are off by `error`, of the column "one" or "two".
ChartRow row(const Configuration& c, double error, const std::string& column = "one") {
  ChartRow r{column, c};
  r.particles = c.resolution * c.resolution;
  r.steps = 1000 * c.resolution * std::sqrt(c.stiffness_scale);
  r.seconds = r.particles * r.steps / 1e6;
  r.height = 0.8 * (1 + error);
  r.radius = 1.9 * (1 - error);
  r.outline_error = 0;
  return r;
}

/// Errors 16 %, 8 %, 4 %, 2 % at resolutions 8, 12.5, 20, 32; the reference at 50.
std::vector<ChartRow> halving() {
  std::vector<ChartRow> rows{row(at_resolution({}, 50), 0), row(at_resolution({}, 50), 0, "two")};
  double error = 0.16;
  for (const double n : {8.0, 12.5, 20.0, 32.0}) {
    for (const char* column : {"one", "two"}) rows.push_back(row(at_resolution({}, n), error, column));
    error /= 2;
  }
  return rows;
}

Configuration softer(double n) {
  Configuration c;
  c.stiffness_scale = 0.1;
  c.resolution = n;
  return c;
}

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Choice, TakesTheCheapestThatMeetsTheTolerance) {
  const ChartData data(halving());
  EXPECT_EQ(choose(data, false, 0.20).point.configuration.resolution, 8);
  EXPECT_EQ(choose(data, false, 0.05).point.configuration.resolution, 20);
  EXPECT_EQ(choose(data, false, 0.021).point.configuration.resolution, 32);
  const auto choice = choose(data, false, 0.05);
  EXPECT_EQ(choice.considered, 4);
  EXPECT_EQ(choice.meeting, 2);
  EXPECT_EQ(choice.cheaper->configuration.resolution, 12.5);
}

TEST(Choice, SaysWhatIsBestWhereNoneMeetsTheTolerance) {
  const ChartData data(halving());
  const auto error = error_of([&] { choose(data, false, 0.01); });
  EXPECT_NE(error.find("--tolerance 1%"), error.npos) << error;
  EXPECT_NE(error.find("the best is 2%"), error.npos) << error;
  EXPECT_NE(error.find("32 particles a side"), error.npos) << error;
  EXPECT_NE(error_of([&] { choose(data, true, 0.1); }).find("no configuration for this flow"), error.npos);
}

TEST(Choice, TheWorstColumnAndFailuresCount) {
  auto rows = halving();
  rows.push_back(row(at_resolution({}, 20), 0.2, "two")); // with 4 % in another run: 14 % root mean square
  EXPECT_EQ(choose(ChartData(rows), false, 0.05).point.configuration.resolution, 32);
  rows = halving();
  ChartRow failed{"two", at_resolution({}, 20)};
  failed.failed = true;
  rows.push_back(failed);
  EXPECT_EQ(choose(ChartData(rows), false, 0.05).point.configuration.resolution, 32);
}

TEST(Choice, ASmallErrorAtOneResolutionIsLuck) {
  auto rows = halving();
  for (auto& r : rows)
    if (r.configuration.resolution == 8) r = row(r.configuration, 0.01, r.column);
  EXPECT_EQ(choose(ChartData(rows), false, 0.05).point.configuration.resolution, 20);
}

TEST(Choice, SofterSandIsTakenWhereItSavesAndIsRight) {
  auto rows = halving();
  for (const char* column : {"one", "two"}) rows.push_back(row(softer(20), 0.045, column));
  EXPECT_EQ(choose(ChartData(rows), false, 0.05).point.configuration, softer(20));
  EXPECT_EQ(choose(ChartData(rows), false, 0.042).point.configuration, at_resolution({}, 20));
  Configuration single = at_resolution({}, 20); // costs as much: no reason to depart from the default
  single.precision = "single";
  rows = halving();
  for (const char* column : {"one", "two"}) rows.push_back(row(single, 0.03, column));
  EXPECT_EQ(choose(ChartData(rows), false, 0.05).point.configuration, at_resolution({}, 20));
}

TEST(Interval, HoldsEightOfTenPairsOfColumnsLeftOutAndIsNoNarrowerThanTheChart) {
  // Error e at n, 2e at n / 1.6: the difference is about e, the chart's error of the other column is e.
  const auto interval = calibrate_interval(ChartData(halving()), false);
  EXPECT_EQ(interval.pairs, 6);
  EXPECT_EQ(interval.factor.height, 1); // e / hypot(e, e) is below 1
  auto rows = halving();
  rows.push_back(row(at_resolution({}, 20), 0.2, "two"));
  EXPECT_EQ(calibrate_interval(ChartData(rows), false).factor.height,
            1); // one pair of eight is held by nothing
  // Four of fourteen, beyond the other column's root mean square, 16 %.
  for (const auto* column : {"one", "one", "two"}) rows.push_back(row(at_resolution({}, 20), 0.2, column));
  const auto wide = calibrate_interval(ChartData(rows), false);
  EXPECT_EQ(wide.pairs, 14);
  EXPECT_NEAR(wide.factor.height,
              0.2 / std::hypot(std::sqrt((2 * 0.2 * 0.2 + 0.04 * 0.04) / 3), 1.08 / 1.2 - 1), 1e-3);
  rows = halving();
  std::erase_if(rows, [](const ChartRow& r) { return r.column == "two"; });
  const auto alone = calibrate_interval(ChartData(rows), false); // nothing to judge by
  EXPECT_EQ(alone.pairs, 0);
  EXPECT_EQ(alone.factor.height, 1);
  EXPECT_EQ(half_width(1, 0.03, 0.04), 0.05);
}

TEST(Tolerance, IsAShareOrPerCent) {
  EXPECT_DOUBLE_EQ(read_tolerance("5%"), 0.05);
  EXPECT_DOUBLE_EQ(read_tolerance("0.05"), 0.05);
  for (const char* wrong : {"5", "0", "-1%", "51%", "", "%", "5 %", "five", "nan%"})
    EXPECT_NE(error_of([&] { read_tolerance(wrong); }).find("expected a share"), std::string::npos) << wrong;
}

TEST(Tolerance, SmallGrainsNeedFinerParticles) {
  host::Scene scene;
  scene.column = {0.05, 0.1};
  scene.grain_diameter = 0.00295;
  EXPECT_NEAR(scene_resolution(scene, 20), 20, 1e-3);
  scene.column = {0.05, 0.05};
  EXPECT_EQ(scene_resolution(scene, 20), 20);
  scene.grain_diameter = 0.001;
  EXPECT_NEAR(scene_resolution(scene, 20), 20 * 0.04172 * 0.05 / 0.001, 0.01);
}

TEST(Outlines, AreaBetweenThem) {
  const Outline cone{{0, 1}, {1, 0}}, wide{{0, 2}, {1, 0}};
  EXPECT_NEAR(area_between(cone, wide), 0.5, 1e-3);
  EXPECT_EQ(area_between(cone, cone), 0);
  const auto mean = mean_outline({cone, {{0, 1}, {3, 2}}});
  EXPECT_EQ(mean.heights, (std::vector<double>{2, 1}));
  EXPECT_EQ(cone.at(0.25), 0.75);
  EXPECT_EQ(cone.at(1.5), 0);
}

TEST(ChartTable, ReadsWhatItWrites) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("chart_table_{}.csv", getpid());
  auto rows = halving();
  rows.push_back({"two", softer(10), 1, true});
  write_chart_table(file, rows);
  const auto again = read_chart_table(file);
  ASSERT_EQ(again.size(), rows.size());
  EXPECT_EQ(again.back().configuration, softer(10));
  EXPECT_TRUE(again.back().failed && std::isnan(again.back().height));
  EXPECT_NEAR(again[2].height, rows[2].height, 1e-4);
  std::filesystem::remove(file);
}

} // namespace
