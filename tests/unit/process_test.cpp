// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/process.hpp"
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <stdexcept>

using drivers::run_program;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Process : testing::Test {
  std::filesystem::path folder = std::filesystem::temp_directory_path() / "simsand_process_test";
  Process() { std::filesystem::create_directories(folder); }
  ~Process() override { std::filesystem::remove_all(folder); }
};

} // namespace

TEST_F(Process, ArgumentsArriveAsTheyAre) {
  const auto log = (folder / "log").string();
  const std::string hostile = "a'b; touch \"$HOME\" `x` \\ \n*";
  EXPECT_EQ(run_program({{"printf", "%s|%s", hostile, ""}, log}), 0);
  EXPECT_EQ(content(log), hostile + "|");
}

TEST_F(Process, StatusAndSignalAreReturned) {
  EXPECT_EQ(run_program({{"sh", "-c", "exit 7"}}), 7);
  EXPECT_EQ(run_program({{"sh", "-c", "kill -TERM $$"}}), 128 + SIGTERM);
}

TEST_F(Process, AProgramThatIsMissingIsNamed) {
  try {
    run_program({{"/nowhere/program", "x"}});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/nowhere/program: cannot be started: No such file or directory");
  }
  EXPECT_THROW(run_program({{"true"}, "/nowhere/log"}), std::runtime_error);
}

TEST_F(Process, TextForAShellReadsBackToTheSameArguments) {
  const auto log = (folder / "log").string();
  const std::string hostile = "it's $1 \"quoted\"";
  const auto line = drivers::shell_text({"printf", "%s|%s|%s", hostile, "", "plain-1.5"});
  EXPECT_EQ(run_program({{"sh", "-c", line}, log}), 0);
  EXPECT_EQ(content(log), hostile + "||plain-1.5");
}
