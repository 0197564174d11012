// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/process.hpp"
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace drivers {
namespace {

/// In the new process: becomes the program, or writes errno into `report` and ends. Between fork and exec only calls
/// that are safe after a fork of a program with threads: none that takes memory.
[[noreturn]] void become(const Program& program, char* const* arguments, int report) {
  if (program.ends_with_parent) prctl(PR_SET_PDEATHSIG, SIGTERM);
  bool ready = true;
  if (!program.log.empty()) {
    const int file = open(program.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ready = file >= 0 && dup2(file, STDOUT_FILENO) >= 0 && dup2(file, STDERR_FILENO) >= 0;
  }
  if (ready) execvp(arguments[0], arguments);
  const int error = errno;
  [[maybe_unused]] const auto written = write(report, &error, sizeof error);
  _exit(127);
}

[[noreturn]] void refuse(const Program& program, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot be started: {}", program.command.front(), std::strerror(error)));
}

/// Waits until the pipe closes, which exec does; what the child wrote before is its errno.
int error_of_child(int pipe) {
  int error = 0;
  ssize_t count = 0;
  do count = read(pipe, &error, sizeof error);
  while (count < 0 && errno == EINTR);
  return count == ssize_t(sizeof error) ? error : 0;
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

pid_t start_program(const Program& program) {
  std::vector<char*> arguments;
  for (const auto& word : program.command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> report{};
  if (pipe2(report.data(), O_CLOEXEC) != 0) refuse(program, errno);
  const pid_t process = fork();
  if (process == 0) become(program, arguments.data(), report[1]);
  int error = process < 0 ? errno : 0;
  close(report[1]);
  if (process > 0) error = error_of_child(report[0]);
  close(report[0]);
  if (process > 0 && error != 0) wait_for(process);
  if (error != 0) refuse(program, error);
  return process;
}

int run_program(const Program& program) {
  return wait_for(start_program(program));
}

Words python_command(const std::string& script, const Words& arguments) {
  Words command{std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3", script};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

int run_python(const std::string& script, const Words& arguments) {
  return run_program({python_command(script, arguments)});
}

std::string shell_text(const Words& command) {
  std::string text;
  for (const auto& word : command) {
    if (!text.empty()) text += ' ';
    if (!word.empty() &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "_-./=:,+%@") == word.npos) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

} // namespace drivers
