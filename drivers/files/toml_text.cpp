// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/toml_text.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace drivers {
namespace {

template <class T> std::string written_array(const std::vector<T>& values) {
  Words parts;
  for (const auto& v : values) parts.push_back(written(v));
  return fmt::format("[{}]", joined(parts));
}

/// Levenshtein distance: edits that turn one key into the other.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replace = corner + (a[i] != b[j]);
      corner = row[j + 1];
      row[j + 1] = std::min({replace, corner + 1, row[j] + 1});
    }
  }
  return row.back();
}

} // namespace

std::string joined(const Words& texts, std::string_view separator) {
  std::string out;
  for (const auto& text : texts) out.append(out.empty() ? "" : separator).append(text);
  return out;
}

std::string toml_number(double value) {
  const auto text = fmt::format("{}", value); // shortest text that reads back to the same bits
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

std::string quoted_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", int(c));
    else
      out += c;
  return out + '"';
}

std::string written_key(std::string_view key) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), bare) ? std::string(key) : quoted_text(key);
}

std::string dotted(const std::string& table, std::string_view key) {
  return table.empty() ? std::string(key) : table + '.' + std::string(key);
}

std::string written(double value) {
  return toml_number(value);
}
std::string written(const std::string& value) {
  return quoted_text(value);
}
std::string written(const std::vector<double>& values) {
  return written_array(values);
}
std::string written(const Words& values) {
  return written_array(values);
}

std::string nearest_word(std::string_view key, const Words& candidates) {
  std::string nearest;
  std::size_t distance = std::max<std::size_t>(2, key.size() / 3) + 1;
  for (const auto& candidate : candidates)
    if (const auto d = edits(key, candidate); d > 0 && d < distance) distance = d, nearest = candidate;
  return nearest;
}

} // namespace drivers
