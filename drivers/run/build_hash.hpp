// SPDX-License-Identifier: BSD-3-Clause
// Which files made a result: tells builds apart that have the same version.
#pragma once
#include <filesystem>
#include <string>

namespace drivers {

/// FNV-1a of a file's content, 64 bit, as sixteen hexadecimal digits: tells files apart that differ by accident.
std::string file_hash(const std::filesystem::path& path);

/// Hashes of a program and of a material library, with a space between.
std::string build_hash(const std::filesystem::path& program, const std::filesystem::path& library);

} // namespace drivers
