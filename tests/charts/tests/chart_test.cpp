// SPDX-License-Identifier: BSD-3-Clause
// The charts as commands, on small settings: their tables, their refusals, and that they can fail.
#include "tests/charts/cycles.hpp"
#include "tests/charts/element_chart.hpp"
#include "tests/charts/increments.hpp"
#include "tests/charts/random_states.hpp"
#include "tests/charts/stability.hpp"
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

std::string content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> lines(const fs::path& file) {
  std::vector<std::string> all;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// A fresh folder of the running test; the program runs in it.
fs::path folder() {
  const auto path =
      fs::absolute("chart_results") / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(path);
  return path;
}

Outcome chart(const std::string& words) {
  const auto at = folder();
  const auto command = fmt::format("cd '{}' && exec timeout 200 '{}/simsand-chart' {} >out 2>err",
                                   at.string(), SIMSAND_BINARY_DIR, words);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(at / "out"), content(at / "err")};
}

std::vector<double> numbers(const std::string& line) {
  std::vector<double> out;
  std::stringstream row(line);
  for (std::string word; std::getline(row, word, ',');) out.push_back(std::strtod(word.c_str(), nullptr));
  return out;
}

const std::string small_element =
    "element --increments 1e-5 --pressures 1000 --stages 0.5 --repetitions 1 -o results";

TEST(Chart, ElementWritesItsTableAndDrawsIt) {
  fs::remove_all(folder() / "results");
  const bool draws = std::system("/usr/bin/python3 -c 'import matplotlib' 2>/dev/null") == 0;
  const auto outcome = chart(small_element + (draws ? "" : " --no-figures"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(fs::exists(folder() / "results/integrators.png"), draws);
  const auto table = lines(folder() / "results/element.csv");
  ASSERT_GT(table.size(), 10u);
  EXPECT_EQ(table.front(), charts::element_header);
  std::map<std::string, double> error;
  for (const auto& line : table) {
    const auto row = numbers(line);
    if (line.find(",all,") == std::string::npos || line.starts_with('"')) continue;
    ASSERT_EQ(row.size(), 15u) << line;
    EXPECT_EQ(row[5], 63) << "3 sands, 7 paths, 3 densities";
    EXPECT_GT(row[14], 0);
    error[line.substr(0, line.find(",1e-05"))] = row[8]; // of 95 %
  }
  EXPECT_LT(error.at("backward Euler,parts=32"), error.at("backward Euler,parts=1") / 16);
  EXPECT_LT(error.at("modified Euler,tolerance=1e-06"), 1e-5);
  const auto best = charts::all_methods();
  EXPECT_EQ(charts::method_named(best, "product, blocks", "parts=1").yield_tolerance, 1e-6);
}

TEST(Chart, ElementSaysWhatDrawingLacks) {
  fs::remove_all(folder() / "results");
  std::ofstream(folder() / "matplotlib.py") << "raise ImportError('none here')\n";
  setenv("PYTHONPATH", folder().c_str(), 1);
  const auto outcome = chart(small_element);
  unsetenv("PYTHONPATH");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.err.starts_with("figures.py: needs numpy and matplotlib (none here): apt-get install "))
      << outcome.err;
  EXPECT_NE(outcome.err.find("simsand-chart: results: figures were not drawn"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder() / "results/element.csv"));
}

TEST(Chart, TheProductIsOneUpdateInWhateverWayItIsCalled) {
  const auto cases = charts::laboratory_cases({{1e3}, {0.5}, 3}, 1e-4);
  std::vector<std::vector<double>> props;
  for (const auto& sand : charts::sands) props.push_back(charts::properties(sand));
  std::vector<charts::Method> methods;
  for (const auto* name : {"product, one point", "product, blocks", "product, blocks, single"})
    methods.push_back(charts::method_named(charts::all_methods(), name, "parts=1"));
  std::vector<charts::Row> all;
  for (const auto& row : charts::compare(cases, props, methods, 1))
    if (row.group == "all") all.push_back(row);
  ASSERT_EQ(all.size(), 3u);
  for (const auto& row : all) {
    EXPECT_EQ(row.not_finite + row.not_converged + row.drifted + row.over_a_tenth, 0);
    EXPECT_NEAR(row.error_95, all[0].error_95, 1e-4);
  }
  EXPECT_NEAR(all[1].error_95, all[0].error_95, 1e-9);
}

TEST(Chart, IncrementsOfARun) {
  const auto scene = std::string(SIMSAND_SOURCE_DIR) + "/data/scenes/default.toml";
  const auto outcome = chart("increments '" + scene + "' --end-time 0.02 --samples 200 -o results");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto table = lines(folder() / "results/increments.csv");
  EXPECT_EQ(table.at(0), charts::increments_header);
  double updates = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto row = numbers(table[i]);
    ASSERT_EQ(row.size(), 9u);
    EXPECT_LT(row[1], row[2]);
    EXPECT_LT(row[3], row[4]);
    for (int k = 5; k < 9; ++k) updates += row[k];
  }
  int particles = 0, steps = 0;
  ASSERT_EQ(std::sscanf(outcome.out.c_str(), "%d particles, %d steps", &particles, &steps), 2);
  EXPECT_EQ(updates, double(particles) * steps);

  std::vector<double> props;
  const auto cases = charts::sampled_cases((folder() / "results/states.csv").string(), props);
  EXPECT_EQ(cases.size(), 200u);
  EXPECT_EQ(props.size(), 14u);
  // Twice, and on two threads: the same file.
  const auto before = content(folder() / "results/states.csv") + content(folder() / "results/increments.csv");
  chart("-t 2 increments '" + scene + "' --end-time 0.02 --samples 200 -o results");
  EXPECT_EQ(before, content(folder() / "results/states.csv") + content(folder() / "results/increments.csv"));
}

void expect_refusal(const Outcome& outcome, const std::string& part) {
  EXPECT_NE(outcome.status, 0);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

TEST(Chart, RefusesBadFilesWithOneLine) {
  expect_refusal(chart("element --states nowhere.csv"), "nowhere.csv: cannot be read");
  const auto states = [&](const std::string& text) {
    std::ofstream(folder() / "states.csv") << text;
    return chart("element --states states.csv");
  };
  expect_refusal(states("strain\n"), "states.csv:1: expected '# properties'");
  expect_refusal(states("# properties 100 0.2\n"), "states.csv:1: property 3 is missing");
  const std::string good = "# properties 100 0.2 0.51 24 0.76 0.04 0.3 1 0.0015 3.3 1 0.4451 101325 1\n";
  expect_refusal(states(good + "a,b\n"), "states.csv:2: expected the columns strain_11");
  expect_refusal(states(good + charts::states_header + "\n1,2\n"), "states.csv:3: expected 11 numbers");
  expect_refusal(states(good + charts::states_header + "\n0,0,0,0,1,1,1,0,-1,0,0\n"),
                 "states.csv:3: expected a positive void ratio");
  expect_refusal(chart("increments nowhere.toml"), "nowhere.toml");
  expect_refusal(chart("element --increments 2"), "--increments");
  expect_refusal(chart("nonsense"), "simsand-chart");
}

TEST(Random, NumbersDependNeitherOnThreadsNorOnWhereARunWasCut) {
  const auto one = chart("-t 1 random -q -n 5120 --compared 0.05"),
             two = chart("-t 2 random -q -n 5120 --compared 0.05");
  EXPECT_EQ(one.status, 0) << one.out;
  EXPECT_EQ(one.out, two.out);
  charts::RandomReport whole, parts;
  for (int b = 0; b < 8; ++b) whole.add(charts::check_block({}, b));
  for (int b = 7; b >= 0; --b) parts.add(charts::check_block({}, b));
  EXPECT_EQ(whole.origins, parts.origins);
  EXPECT_EQ(whole.answers, parts.answers);
  EXPECT_EQ(whole.largest_yield, parts.largest_yield);
}

TEST(Random, AMaterialThatIsNoSandFails) {
  const auto outcome =
      chart(fmt::format("random -q -n 1280 --library '{}/test_vumats/libelastic.so'", SIMSAND_BINARY_DIR));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("VIOLATED"), std::string::npos);
  EXPECT_NE(outcome.out.find("bad input not refused"), std::string::npos);
}

TEST(Cycles, ElasticDefectIsThatOfTheShearModulus) {
  // Sheared at p1, compressed to p2, sheared back, expanded: work (G1 - G2) shear^2 times 2, for tensor shear.
  const auto m = charts::material_of(charts::properties(charts::sands[0]));
  const double e = 0.6, p1 = 1e3, p2 = 2e3, shear = 1e-6;
  const auto measure = [&](double p) { return simsand::pressure_of_mean_stress(m, p); };
  const double volume =
      (measure(p2).measure - measure(p1).measure) / (m.given.K0 * simsand::void_ratio_factor(e));
  charts::Tensor compressed = simsand::add_mean(charts::Tensor{}, volume / 3), sheared{}, both = compressed;
  sheared[3] = both[3] = shear;
  const charts::Point start{simsand::add_mean(charts::Tensor{}, p1), e, 0.1, 0};
  charts::Point point = start;
  const auto sum = charts::lead_through(m, point, {charts::Tensor{}, sheared, both, compressed}, 500, 1);
  const double G1 = m.shear_ratio * simsand::bulk_modulus(m, e, measure(p1));
  const double G2 =
      m.shear_ratio * simsand::bulk_modulus(m, simsand::void_ratio_after(e, volume), measure(p2));
  EXPECT_NEAR(sum.work, 2 * (G2 - G1) * shear * shear, 1e-3 * sum.work);
  EXPECT_NEAR(sum.stored + sum.defect, sum.work, 1e-6 * sum.work);
  EXPECT_EQ(sum.dissipation, 0);
  // Without shear there is no defect.
  point = start;
  const auto isotropic = charts::lead_through(m, point, {charts::Tensor{}, compressed}, 500, 3);
  EXPECT_LT(std::abs(isotropic.work), 1e-6 * isotropic.gross);
}

TEST(Cycles, GiveNothingAwayBeyondTheDefect) {
  const auto outcome = chart("cycles -n 200 -o cycles.csv");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  const auto table = lines(folder() / "cycles.csv");
  ASSERT_EQ(table.size(), 1001u);
  // The check can fail: without the defect there are cycles that give energy away, and plastic ones that take much.
  int gifts = 0, plastic = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto row = numbers(table[i]);
    ASSERT_EQ(row.size(), 9u);
    gifts += row[1] - row[4] < -1e-6 * row[2];
    plastic += row[6] > 0;
    EXPECT_GE(row[3], 0);
  }
  EXPECT_GT(gifts, 20);
  EXPECT_GT(plastic, 300);
}

TEST(Stability, WhatIsKnownIsNotRunAgain) {
  const auto table = folder() / "results/stability.csv";
  fs::remove(table);
  const auto first = chart("stability --quick -o results");
  ASSERT_EQ(first.status, 0) << first.err;
  auto rows = lines(table);
  ASSERT_EQ(rows.size(), 17u);
  EXPECT_EQ(rows[0], charts::stability_header);
  int holds = 0, stopped = 0;
  for (const auto& row : rows) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 20) << row;
    holds += row.ends_with(",holds");
    stopped += row.find(",stopped: ") != std::string::npos;
    // In axisymmetry the ring next to the axis bounds the step.
    const bool too_large =
        row.find(",4.8,") != std::string::npos && row.find("plane_strain") != std::string::npos;
    EXPECT_TRUE(!too_large || row.find(",stopped: ") != std::string::npos) << row;
  }
  EXPECT_GE(holds, 4);
  EXPECT_GE(stopped, 5);
  // Cut off in a line: what is whole is kept, the rest run again, on other threads, with the same numbers.
  const auto whole = content(table);
  std::ofstream(table) << whole.substr(0, whole.size() / 2);
  const auto second = chart("-t 2 stability --quick -o results");
  EXPECT_EQ(content(table), whole);
  EXPECT_EQ(second.out.find("16 of them now"), std::string::npos);
  EXPECT_NE(chart("stability --quick -o results").out.find("0 of them now"), std::string::npos);
  std::ofstream(table) << "something else\n";
  expect_refusal(chart("stability --quick -o results"), "stability.csv:1: expected the columns");
}

} // namespace
