// SPDX-License-Identifier: BSD-3-Clause
// The program as its user has it: run in a folder of the test, in front or behind.
#pragma once
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace tests {

struct Outcome {
  int status;
  std::string out, err;
};

inline std::string program_path() {
  return std::string(SIMSAND_BINARY_DIR) + "/simsand";
}

/// Exit status of a child, or minus the signal that ended it.
inline int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// A folder, fresh at the start, in which the program runs; its output goes to the files `out` and `err`.
struct Program {
  std::filesystem::path folder;

  explicit Program(const std::string& name)
      : folder(std::filesystem::path(SIMSAND_BINARY_DIR) / "test_results" / name) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  std::string content(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(folder / name).rdbuf();
    return text.str();
  }

  /// Starts a shell's `command`; the process is the command's own if it begins with exec.
  pid_t start_shell(const std::string& command) const {
    const auto line = fmt::format("cd '{}' && {{ {} ; }} >out 2>err", folder.string(), command);
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    return child;
  }
  pid_t start(const std::string& arguments, const std::string& before = "") const {
    return start_shell(fmt::format("{} exec '{}' {}", before, program_path(), arguments));
  }
  Outcome shell(const std::string& command) const {
    const int status = wait_for(start_shell(command));
    return {status, content("out"), content("err")};
  }
  Outcome run(const std::string& arguments, const std::string& before = "") const {
    const int status = wait_for(start(arguments, before));
    return {status, content("out"), content("err")};
  }
};

/// Overwrites the third fifth of a file, as a lost block of the disk would.
inline void damage(const std::filesystem::path& path) {
  const auto fifth = std::filesystem::file_size(path) / 5;
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(std::streamoff(2 * fifth));
  file << std::string(fifth, 0);
}

} // namespace tests
