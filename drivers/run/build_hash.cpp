// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/build_hash.hpp"
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace drivers {

std::string file_hash(const std::filesystem::path& path) {
  std::stringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : content.view()) hash = (hash ^ std::uint8_t(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

std::string build_hash(const std::filesystem::path& program, const std::filesystem::path& library) {
  return file_hash(program) + " " + file_hash(library);
}

} // namespace drivers
