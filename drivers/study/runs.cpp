// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/runs.hpp"
#include "drivers/scene_file.hpp"
#include "drivers/study/jobs.hpp"
#include "host/output.hpp"
#include "host/result_read.hpp"
#include "host/vumat_library.hpp"
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

bool is_done(const StudyRun& run, const host::Scene& scene) {
  const auto result = fs::path(run.folder) / "result.h5";
  try {
    return fs::exists(result) && host::stored_scene(result) == scene.resolved &&
           host::is_complete_result(result);
  } catch (const std::runtime_error&) {
    return false; // unreadable: run it again
  }
}

Job job_of(const StudyRun& run, const host::Scene& scene) {
  const auto& [radius, height] = scene.column;
  Job job{run.name,
          {host::beside_program("simsand"), "run", run.scene, "--threads", "1", "--quiet"},
          run.folder + "/run.log",
          radius * std::pow(height, 1.5) / std::pow(scene.spacing, 3)}; // particles times steps
  for (const auto& setting : run.settings) job.command.insert(job.command.end(), {"--set", setting});
  return job;
}

} // namespace

void run_missing(std::vector<StudyRun> runs, const StudyOptions& options) {
  std::vector<Job> jobs;
  for (auto& run : runs) {
    run.settings.push_back("output.folder=" + run.folder);
    const auto scene = read_scene(run.scene, run.settings);
    if (!is_done(run, scene)) jobs.push_back(job_of(run, scene));
  }
  if (!options.quiet)
    spdlog::info("{} runs, {} of them to do, {} at a time", runs.size(), jobs.size(), options.parallel);
  const auto failed =
      run_jobs(jobs, options.parallel, [&](const Job& job, bool ok, int left, double seconds) {
        if (!options.quiet)
          spdlog::info("{:<28}{:<8}{:3} left, about {:.1f} minutes", job.name, ok ? "done" : "failed", left,
                       seconds / 60);
      });
  if (!failed.empty())
    throw std::runtime_error(fmt::format("{} of {} runs failed: {}; see run.log in their folders below {}",
                                         failed.size(), jobs.size(), fmt::join(failed, ", "),
                                         options.folder));
}

void report_study(const std::string& script, const StudyOptions& options) {
  const auto file = fs::path(options.data).parent_path() / "drivers/figures" / script;
  const auto command =
      fmt::format("/usr/bin/python3 '{}' '{}' --data '{}'", file.string(), options.folder, options.data);
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error(
        fmt::format("the runs are complete, but their report failed; to repeat it: {}", command));
}

} // namespace drivers
