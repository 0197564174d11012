// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/decoded_text.hpp"
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iconv.h>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace drivers {
namespace {

/// `bytes` as UTF-8; the position of the first byte that the encoding does not have, if there is one.
struct Conversion {
  std::string text;
  std::optional<std::size_t> invalid;
};

Conversion convert(std::string_view bytes, const std::string& encoding, const std::string& file) {
  const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  if (converter == iconv_t(-1))
    throw std::runtime_error(
        fmt::format("{}: expected an encoding that `iconv -l` lists, found \"{}\"", file, encoding));
  Conversion out;
  char* in = const_cast<char*>(bytes.data()); // iconv does not write there
  std::size_t left = bytes.size();
  while (left > 0) {
    char block[4096];
    char* to = block;
    std::size_t room = sizeof block;
    const auto status = iconv(converter, &in, &left, &to, &room);
    out.text.append(block, sizeof block - room);
    if (status == std::size_t(-1) && errno != E2BIG) {
      out.invalid = bytes.size() - left;
      break;
    }
  }
  iconv_close(converter);
  return out;
}

/// Encoding by the byte order mark; its length.
struct Mark {
  std::string_view bytes, encoding;
};
constexpr Mark marks[] = {{"\xEF\xBB\xBF", "UTF-8"}, {"\xFF\xFE", "UTF-16LE"}, {"\xFE\xFF", "UTF-16BE"}};

/// UTF-16 without a mark: text of Western languages then has a zero in every other byte.
std::string unmarked_utf16(std::string_view bytes) {
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < bytes.size(); ++i) zeros[i % 2] += bytes[i] == '\0';
  const auto half = bytes.size() / 2;
  if (bytes.size() % 2 == 0 && zeros[1] == half && zeros[0] == 0) return "UTF-16LE";
  if (bytes.size() % 2 == 0 && zeros[0] == half && zeros[1] == 0) return "UTF-16BE";
  return "";
}

DecodedText checked(std::string_view bytes, const std::string& encoding, const std::string& file) {
  auto result = convert(bytes, encoding, file);
  if (!result.invalid) return {std::move(result.text), encoding};
  const auto line = 1 + std::count(bytes.begin(), bytes.begin() + long(*result.invalid), '\n');
  throw std::runtime_error(fmt::format("{}:{}: byte 0x{:02X} is not {}: state the encoding of the file, key "
                                       "'encoding'",
                                       file, line, static_cast<unsigned char>(bytes[*result.invalid]),
                                       encoding));
}

} // namespace

std::string read_bytes(const std::string& file) {
  std::error_code unknown;
  const auto status = std::filesystem::status(file, unknown);
  if (!std::filesystem::exists(status)) throw std::runtime_error(file + ": no such file");
  if (!std::filesystem::is_regular_file(status))
    throw std::runtime_error(file + ": expected a file, found a folder, a device or a pipe");
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return bytes;
}

DecodedText decode(const std::string& bytes, const std::string& file, const std::string& encoding) {
  std::string_view rest = bytes;
  for (const auto& mark : marks)
    if (rest.starts_with(mark.bytes) && (encoding.empty() || encoding == mark.encoding))
      return checked(rest.substr(mark.bytes.size()), std::string(mark.encoding), file);
  if (!encoding.empty()) return checked(rest, encoding, file);
  if (rest.find('\0') != rest.npos) {
    const auto wide = unmarked_utf16(rest);
    if (wide.empty())
      throw std::runtime_error(file + ": expected text, found bytes that are zero: state the encoding of the "
                                      "file, key 'encoding'");
    return checked(rest, wide, file);
  }
  if (auto plain = convert(rest, "UTF-8", file); !plain.invalid) return {std::move(plain.text), "UTF-8"};
  return checked(rest, "windows-1252", file);
}

} // namespace drivers
