// SPDX-License-Identifier: BSD-3-Clause
// A checksum over a whole file, in its last 16 bytes: 8 letters and the 64-bit FNV-1a sum of all bytes before them. Any
// single damaged byte changes the sum, wherever it lies. HDF5 ignores what follows the end of its own data.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace host {

/// FNV-1a, 64 bit; `before` is the sum of what precedes.
std::uint64_t checksum(std::string_view bytes, std::uint64_t before = 14695981039346656037ULL);

/// The bytes with their seal at the end.
std::string sealed(std::string bytes);

/// Appends the seal to a finished file. Throws std::system_error naming it.
void append_seal(const std::filesystem::path& path);

/// True if the file ends with the seal of its content; false also if it cannot be read.
bool has_intact_seal(const std::filesystem::path& path);

} // namespace host
