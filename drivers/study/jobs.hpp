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
  double memory = 0;                ///< bytes, expected at most
  bool whole = true;                ///< false: it goes on with what an earlier one began
};

/// Called when a job has ended; `cpu_seconds` is what it took of a processor, `left` seconds are expected until all
/// have ended.
using JobEnded =
    std::function<void(const Job&, bool succeeded, double cpu_seconds, int jobs_left, double seconds_left)>;

/// What jobs may take together.
struct JobLimits {
  int parallel = 1;  ///< jobs at a time
  double memory = 0; ///< bytes; a job that needs more than is left waits until it runs alone
};

/// Memory of this computer that programs can still take, bytes; without bound where the system does not tell.
double available_memory();

/// Runs all jobs within the limits and returns the names of those that failed. The jobs end with this program, also
/// when it is killed. Throws std::runtime_error if a process cannot be started.
std::vector<std::string> run_jobs(std::vector<Job> jobs, const JobLimits& limits, const JobEnded& ended);

} // namespace drivers
