// SPDX-License-Identifier: BSD-3-Clause
// Text files in any encoding, turned to UTF-8 by iconv of the C library. Errors are std::runtime_error, one line that
// begins with the file.
#pragma once
#include <string>

namespace drivers {

struct DecodedText {
  std::string text;     ///< UTF-8 without byte order mark
  std::string encoding; ///< of the file, as iconv names it
};

/// The bytes of a regular file; an error for a folder, a device or a pipe, which may never end.
std::string read_bytes(const std::string& file);

/// Decodes `bytes`. Without `encoding` the byte order mark decides; without a mark, UTF-8 if the bytes are valid UTF-8,
/// UTF-16 if every other byte is zero, windows-1252 (which holds Latin-1) otherwise. Digits, signs and separators are
/// the same in all encodings of one byte, so that a wrong one can spoil names but not numbers.
DecodedText decode(const std::string& bytes, const std::string& file, const std::string& encoding = "");

} // namespace drivers
