// SPDX-License-Identifier: BSD-3-Clause
// What a plan says, against the run; and what `simsand info` says of the result.
#include "drivers/run/info.hpp"
#include "drivers/run/plan.hpp"
#include "tests/verification/program.hpp"
#include "tests/verification/scenes.hpp"
#include <cmath>
#include <ctime>
#include <omp.h>

namespace {

using tests::value_of;

double cpu_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

void expect_within(double factor, double planned, double found, const std::string& what) {
  EXPECT_LT(std::abs(std::log(planned / found)), std::log(factor))
      << what << ": " << planned << ", " << found;
}

TEST(Plan, HoldsWithinAFactorOfOneAndAHalf) {
  omp_set_num_threads(1);
  double log_sum = 0;
  int cases = 0;
  for (const auto& c :
       std::vector<tests::ColumnCase>{{.aspect = 0.5, .spacing = 0.005},
                                      {.aspect = 1, .spacing = 0.005},
                                      {.aspect = 4, .spacing = 0.005},
                                      {.geometry = "plane_strain", .aspect = 4, .spacing = 0.005},
                                      {.geometry = "plane_strain", .aspect = 1, .spacing = 0.003}}) {
    const auto name = fmt::format("plan_{}_{}_{}", c.geometry, c.aspect, c.spacing);
    const auto scene = tests::column_scene(c, name);
    const auto plan = drivers::plan_run(scene);
    EXPECT_FALSE(std::filesystem::exists(scene.output_folder + "/result.h5")) << "a plan writes nothing";
    const double start = cpu_seconds();
    const auto run = drivers::run_scene(scene, {.quiet = true});
    const double seconds = cpu_seconds() - start, end = value_of(run, "end_time"),
                 steps = value_of(run, "steps");
    EXPECT_EQ(plan.particles, value_of(run, "particles"));
    expect_within(1.5, plan.step, end / steps, name + " step");
    expect_within(1.5, plan.seconds_per_step, seconds / steps, name + " seconds per step");
    // Single times to rest scatter by more (tests/benchmark/plan.py); all of them together do not.
    expect_within(2.5, plan.end, end, name + " end");
    expect_within(1.6, plan.disk, double(std::filesystem::file_size(scene.output_folder + "/result.h5")),
                  name + " disk");
    log_sum += std::log(plan.seconds() / seconds);
    ++cases;
    std::printf("%s: end %.2f, steps %.2f, time %.2f of the run's\n", name.c_str(), plan.end / end,
                plan.steps / steps, plan.seconds() / seconds);
  }
  EXPECT_LT(std::abs(log_sum / cases), std::log(1.5));
}

TEST(Plan, AColumnBehindItsWallIsAtRestAtTheFirstSample) {
  const auto scene =
      tests::column_scene({.spacing = 0.005, .gate = "motion = \"fixed\"", .end_time = 0.1}, "plan_fixed");
  const auto plan = drivers::plan_run(scene, 0.05);
  EXPECT_EQ(plan.end, scene.sample_interval);
  EXPECT_EQ(plan.latest_end, 0.1);
  const auto run = drivers::run_scene(scene, {.quiet = true});
  expect_within(1.1, plan.steps, value_of(run, "steps"), "steps");
}

TEST(Plan, TheProgramSaysItAndRunsNothing) {
  const tests::Program program("plan_program");
  auto scene = tests::column_scene({.spacing = 0.002, .end_time = 0.01}, "plan_scene");
  program.write("scene.toml", scene.resolved);
  const auto plan = program.run("run --plan -t 1 scene.toml -o nowhere");
  EXPECT_EQ(plan.status, 0);
  for (const auto* part :
       {"particles   625 of 2 mm\n", "simulated   0.01 s\n", "steps ", "time ", "memory ", "disk "})
    EXPECT_NE(plan.out.find(part), std::string::npos) << plan.out;
  EXPECT_FALSE(std::filesystem::exists(program.folder / "nowhere"));
  // Memory: as the system counts it for the run.
  const auto run = program.shell(fmt::format(
      "/usr/bin/python3 -c 'import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, "
      "stdout=subprocess.DEVNULL); print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' {} run -q "
      "-t 1 "
      "scene.toml -o results",
      tests::program_path()));
  ASSERT_EQ(run.status, 0) << run.err;
  const double megabytes = std::stod(plan.out.substr(plan.out.find("memory") + 6));
  expect_within(1.5, megabytes, 1024e-6 * std::stod(run.out), "memory");
  const auto info = program.run("info results/result.h5");
  for (const auto* part :
       {"state             complete\n", "particles         625\n", "axisymmetric, column 0.05 m wide"})
    EXPECT_NE(info.out.find(part), std::string::npos) << info.out;
  const auto json = program.shell(fmt::format(
      "{} info --json results/result.h5 | /usr/bin/python3 -c 'import json, sys; d = json.load(sys.stdin); "
      "print(d[\"kind\"], d[\"complete\"], d[\"particles\"], d[\"steps\"] > 0, "
      "d[\"summary\"][\"time_to_rest\"], "
      "len(d[\"snapshot_times\"]), \"kinetic_energy\" in d[\"last_sample\"])'",
      tests::program_path()));
  EXPECT_EQ(json.out, "result True 625 True None 2 True\n") << json.err;
  program.write("text.h5", "no result");
  EXPECT_EQ(program.run("info text.h5").err,
            "simsand: text.h5: neither a readable result nor a readable checkpoint\n");
  EXPECT_EQ(program.run("info nowhere.h5").err, "simsand: nowhere.h5: no such file\n");
}

} // namespace
