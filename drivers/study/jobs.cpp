// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/study/jobs.hpp"
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace drivers {
namespace {

/// In the new process: never returns.
[[noreturn]] void become(std::vector<char*>& arguments, const std::string& log) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0) {
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
  }
  execv(arguments.front(), arguments.data());
  _exit(127);
}

pid_t start(const Job& job) {
  std::filesystem::create_directories(std::filesystem::path(job.log).parent_path());
  std::vector<char*> arguments;
  for (const auto& word : job.command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t process = fork();
  if (process < 0)
    throw std::runtime_error(fmt::format("{}: cannot start a process: {}", job.name, std::strerror(errno)));
  if (process == 0) become(arguments, job.log);
  return process;
}

} // namespace

std::vector<std::string> run_jobs(std::vector<Job> jobs, int parallel, const JobEnded& ended) {
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.cost > b.cost; });
  const double whole = std::accumulate(jobs.begin(), jobs.end(), 0.0,
                                       [](double sum, const Job& job) { return sum + job.cost; });
  const auto began = std::chrono::steady_clock::now();
  std::vector<std::string> failed;
  std::map<pid_t, const Job*> running;
  std::size_t next = 0;
  double done = 0;
  for (int left = int(jobs.size()); left > 0;) {
    while (next < jobs.size() && int(running.size()) < parallel) {
      running[start(jobs[next])] = &jobs[next];
      ++next;
    }
    int status = 0;
    const pid_t process = wait(&status);
    if (process < 0 && errno == EINTR) continue;
    const auto at = running.find(process);
    if (at == running.end()) continue;
    const Job& job = *at->second;
    running.erase(at);
    --left;
    done += job.cost;
    const bool succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!succeeded) failed.push_back(job.name);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    ended(job, succeeded, left, seconds * (whole - done) / done);
  }
  return failed;
}

} // namespace drivers
