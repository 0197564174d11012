// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/build_hash.hpp"
#include "host/files/seal.hpp"
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace drivers {

std::string file_hash(const std::filesystem::path& path) {
  std::stringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return fmt::format("{:016x}", host::checksum(content.view()));
}

std::string build_hash(const std::filesystem::path& program, const std::filesystem::path& library) {
  return file_hash(program) + " " + file_hash(library);
}

} // namespace drivers
