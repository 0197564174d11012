// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/runs.hpp"
#include "drivers/files/resource.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/run/build_hash.hpp"
#include "drivers/run/process.hpp"
#include "drivers/run/resume.hpp"
#include "drivers/study/jobs.hpp"
#include "host/files/output.hpp"
#include "host/files/result_read.hpp"
#include "host/material/library.hpp"
#include <cmath>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <numbers>
#include <spdlog/spdlog.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

fs::path result_of(const StudyRun& run) {
  return fs::path(run.folder) / "result.h5";
}

bool is_done(const StudyRun& run, const host::Scene& scene) {
  const auto result = result_of(run);
  try {
    return fs::exists(result) && host::stored_scene(result) == scene.resolved &&
           host::is_complete_result(result);
  } catch (const std::runtime_error&) {
    return false; // unreadable: run it again
  }
}

/// Whether this program, with the material library as it is now, made the result.
bool is_of_this_build(const StudyRun& run, const host::Scene& scene) {
  static const auto program = host::beside_program("simsand");
  return host::stored_build(result_of(run)) == build_hash(program, scene.material.library.path);
}

/// Of the column at the scene's spacing, about.
double particles_of(const host::Scene& scene) {
  const double radius = scene.column.radius / scene.spacing, height = scene.column.height / scene.spacing;
  if (scene.geometry != host::GeometryKind::three_dimensional) return radius * height;
  const double share = scene.sector == host::Sector::quarter ? 0.25
                       : scene.sector == host::Sector::half  ? 0.5
                                                             : 1;
  return share * std::numbers::pi * radius * radius * height;
}

/// Most memory of a run, bytes: the largest of those measured, at 5,000 and 12,000 particles in two and three
/// dimensions, and half as much again.
double memory_of(double particles) {
  return 40e6 + 4e3 * particles;
}

/// Whether an interrupted run of exactly this scene can go on.
bool can_resume(const StudyRun& run, const host::Scene& scene) {
  try {
    if (!fs::exists(checkpoint_path(run.folder))) return false;
    const auto found = find_resumption(run.folder, "");
    return found && found->scene.resolved == scene.resolved;
  } catch (const std::runtime_error&) {
    return false; // unreadable, or of another version: begin anew
  }
}

Job job_of(const StudyRun& run, const host::Scene& scene) {
  const double particles = particles_of(scene);
  const auto program = host::beside_program("simsand");
  Job job{run.name,
          {program, "run", run.scene, "--threads", "1", "--quiet"},
          run.folder + "/run.log",
          particles * std::sqrt(scene.column.height) / scene.spacing, // particles times steps
          memory_of(particles)};
  if (scene.geometry == host::GeometryKind::three_dimensional) job.cost *= 3; // each has more neighbours
  if (can_resume(run, scene)) {
    job.command = {program, "run", "--resume", run.folder, "--threads", "1", "--quiet"};
    job.whole = false;
    return job;
  }
  for (const auto& setting : run.settings) job.command.insert(job.command.end(), {"--set", setting});
  return job;
}

/// Those to do.
std::vector<Job> missing(std::vector<StudyRun>& runs, bool again) {
  std::vector<Job> jobs;
  int done = 0, older = 0;
  for (auto& run : runs) {
    run.settings.push_back("output.folder=" + run.folder);
    const auto scene = read_scene(run.scene, run.settings);
    const bool complete = is_done(run, scene), other = complete && !is_of_this_build(run, scene);
    if (!complete || (other && again))
      jobs.push_back(job_of(run, scene));
    else
      ++done, older += other;
  }
  if (older > 0)
    spdlog::warn("{} of {} complete results are of another build of simsand or of its material: --again runs "
                 "them again",
                 older, done);
  return jobs;
}

} // namespace

void run_missing(std::vector<StudyRun> runs, const StudyOptions& options) {
  const auto jobs = missing(runs, options.again);
  const JobLimits limits{options.parallel, 0.8 * available_memory()};
  if (!options.quiet)
    spdlog::info("{} runs, {} of them to do, {} at a time", runs.size(), jobs.size(), options.parallel);
  const auto failed =
      run_jobs(jobs, limits, [&](const Job& job, bool ok, double cpu_seconds, int left, double seconds) {
        if (ok && job.whole)
          std::ofstream(fs::path(job.log).parent_path() / "cpu_seconds") << cpu_seconds << '\n';
        if (!options.quiet)
          spdlog::info("{:<36}{:<8}{:3} left, about {:.1f} minutes", job.name, ok ? "done" : "failed", left,
                       seconds / 60);
      });
  if (!failed.empty())
    throw std::runtime_error(fmt::format("{} of {} runs failed: {}; see run.log in their folders below {}",
                                         failed.size(), jobs.size(), fmt::join(failed, ", "),
                                         options.folder));
}

void report_study(const std::string& script, const StudyOptions& options) {
  const auto file = resource("figures/" + script);
  const Words arguments{options.folder, "--data", options.data};
  if (run_python(file, arguments) != 0)
    throw std::runtime_error(fmt::format("the runs are complete, but their report failed; to repeat it: {}",
                                         shell_text(python_command(file, arguments))));
}

void run_and_report(std::vector<StudyRun> runs, const std::string& script, const StudyOptions& options) {
  try {
    run_missing(std::move(runs), options);
  } catch (const std::runtime_error&) {
    const auto first = std::current_exception();
    try {
      report_study(script, options);
    } catch (const std::runtime_error&) { // nothing to report: why is what failed first
    }
    std::rethrow_exception(first);
  }
  report_study(script, options);
}

} // namespace drivers
