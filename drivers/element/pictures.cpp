// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/pictures.hpp"
#include <filesystem>
#include <fmt/format.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace drivers {
namespace {

/// Runs a program with arguments and waits; its exit status, 127 if it cannot be started.
int run_program(Words arguments) {
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  if (posix_spawnp(&child, argv.front(), nullptr, nullptr, argv.data(), environ) != 0) return 127;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return 127;
  return WEXITSTATUS(status);
}

Words critical_numbers(const std::optional<CriticalState>& critical) {
  if (!critical) return {"nan", "nan", "nan", "nan", "nan", "nan"};
  Words out;
  for (const double v : {critical->friction_angle, critical->e_ref, critical->lambda, critical->zeta,
                         critical->p_at, critical->p_min})
    out.push_back(fmt::format("{}", v));
  return out;
}

} // namespace

void run_script(const std::string& name, const Words& arguments, const std::string& folder) {
  const auto script = host::beside_program(name);
  if (!std::filesystem::exists(script))
    throw std::runtime_error(fmt::format("{}: no such script: figures cannot be drawn", script));
  // Debian's Python is the one that has Debian's matplotlib.
  Words all{std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3", script};
  all.insert(all.end(), arguments.begin(), arguments.end());
  if (const int status = run_program(all); status != 0)
    throw std::runtime_error(
        fmt::format("{}: figures were not drawn: {} ended with status {}", folder, script, status));
}

void draw_pictures(const std::vector<Picture>& pictures, const std::string& folder) {
  if (pictures.empty()) return;
  Words arguments{"-o", folder};
  for (const auto& picture : pictures) {
    arguments.emplace_back("--critical");
    for (const auto& number : critical_numbers(picture.critical)) arguments.push_back(number);
  }
  arguments.emplace_back("--");
  for (const auto& picture : pictures) arguments.push_back(picture.table);
  run_script("element_figures.py", arguments, folder);
}

} // namespace drivers
