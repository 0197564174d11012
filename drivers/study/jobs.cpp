// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/jobs.hpp"
#include "drivers/run/process.hpp"
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>

namespace drivers {
namespace {

pid_t start(const Job& job) {
  std::filesystem::create_directories(std::filesystem::path(job.log).parent_path());
  return start_program({job.command, job.log, true});
}

double cpu_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The jobs that run now, and how many of the list were started.
struct Running {
  std::map<pid_t, const Job*> jobs;
  std::size_t next = 0;
  double memory = 0;
};

/// Starts what the limits allow; if nothing runs, one job in any case.
void start_more(const std::vector<Job>& jobs, const JobLimits& limits, Running& running) {
  while (running.next < jobs.size() && int(running.jobs.size()) < limits.parallel) {
    const Job& job = jobs[running.next];
    if (!running.jobs.empty() && running.memory + job.memory > limits.memory) return;
    running.jobs[start(job)] = &job;
    running.memory += job.memory;
    ++running.next;
  }
}

} // namespace

double available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name; file.ignore(256, '\n'))
    if (double kilobytes = 0; name == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

std::vector<std::string> run_jobs(std::vector<Job> jobs, const JobLimits& limits, const JobEnded& ended) {
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.cost > b.cost; });
  const double whole = std::accumulate(jobs.begin(), jobs.end(), 0.0,
                                       [](double sum, const Job& job) { return sum + job.cost; });
  std::signal(SIGCHLD, SIG_DFL); // a caller that ignores it would keep us from the runs' exit codes
  const auto began = std::chrono::steady_clock::now();
  std::vector<std::string> failed;
  Running running;
  double done = 0;
  for (int left = int(jobs.size()); left > 0;) {
    start_more(jobs, limits, running);
    int status = 0;
    rusage usage{};
    const pid_t process = wait4(-1, &status, 0, &usage);
    if (process < 0 && errno == EINTR) continue;
    if (process < 0)
      throw std::runtime_error(fmt::format("cannot learn how the runs ended: {}", std::strerror(errno)));
    const auto at = running.jobs.find(process);
    if (at == running.jobs.end()) continue;
    const Job& job = *at->second;
    running.jobs.erase(at);
    running.memory -= job.memory;
    --left;
    done += job.cost;
    const bool succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!succeeded) failed.push_back(job.name);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    ended(job, succeeded, cpu_seconds(usage), left, seconds * (whole - done) / done);
  }
  return failed;
}

} // namespace drivers
