// SPDX-License-Identifier: BSD-3-Clause
// Programs side by side: each run of a study is a process of its own, so that one that fails takes no other along.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace drivers {

struct Job {
  std::string name;
  std::vector<std::string> command; ///< program and arguments
  std::string log;                  ///< file for its output, replaced
  double cost = 1;                  ///< expected, in any unit: long ones first
};

/// Called when a job has ended; `left` seconds are expected until all have.
using JobEnded = std::function<void(const Job&, bool succeeded, int jobs_left, double seconds_left)>;

/// Runs all jobs, `parallel` at a time, and returns the names of those that failed. The jobs end with this
/// program, also when it is killed. Throws std::runtime_error if a process cannot be started.
std::vector<std::string> run_jobs(std::vector<Job> jobs, int parallel, const JobEnded& ended);

} // namespace drivers
