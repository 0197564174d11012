// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/seal.hpp"
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

namespace host {
namespace {

constexpr std::string_view letters = "SIMSANDS";
constexpr std::size_t seal_size = letters.size() + sizeof(std::uint64_t);

std::string seal_of(std::uint64_t sum) {
  std::array<char, sizeof sum> bytes{};
  std::memcpy(bytes.data(), &sum, sizeof sum);
  return std::string(letters) + std::string(bytes.begin(), bytes.end());
}

/// The sum of the next `size` bytes, read in pieces.
std::uint64_t checksum_of(std::istream& file, std::uintmax_t size) {
  std::vector<char> piece(1 << 20);
  auto sum = checksum({});
  while (size > 0 && file) {
    const auto count = std::min<std::uintmax_t>(size, piece.size());
    file.read(piece.data(), std::streamsize(count));
    sum = checksum({piece.data(), std::size_t(file.gcount())}, sum);
    size -= count;
  }
  return sum;
}

} // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t sum) {
  for (const char c : bytes) sum = (sum ^ std::uint8_t(c)) * 1099511628211ULL;
  return sum;
}

std::string sealed(std::string bytes) {
  bytes += seal_of(checksum(bytes));
  return bytes;
}

void append_seal(const std::filesystem::path& path) {
  std::ifstream content(path, std::ios::binary);
  const auto seal = seal_of(checksum_of(content, std::filesystem::file_size(path)));
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out << seal;
  out.close();
  if (!content || !out) throw std::system_error(errno, std::generic_category(), path.string());
}

bool has_intact_seal(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || size < seal_size) return false;
  std::ifstream file(path, std::ios::binary);
  const auto expected = seal_of(checksum_of(file, size - seal_size));
  std::string found(seal_size, 0);
  file.read(found.data(), std::streamsize(seal_size));
  return bool(file) && found == expected;
}

} // namespace host
