// SPDX-License-Identifier: BSD-3-Clause
#include "tests/abaqus/deck_reader.hpp"
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace deck {
namespace {

constexpr std::size_t longest_line = 256, longest_real = 20, longest_integer = 10;

std::string trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return std::string(text);
}

/// Between commas that are not quoted. A comma at the very end opens no further item.
std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> items;
  bool quoted = false;
  std::string item;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      items.push_back(trimmed(item));
      item.clear();
    } else
      item += c;
  }
  if (!trimmed(item).empty()) items.push_back(trimmed(item));
  return items;
}

void read_keyword_line(std::string_view text, Block& block) {
  const auto items = split(text);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i == 0) {
      std::istringstream words(capitals(items[0].substr(1)));
      for (std::string word; words >> word;) block.keyword += (block.keyword.empty() ? "" : " ") + word;
      continue;
    }
    const auto equals = items[i].find('=');
    Parameter parameter{capitals(trimmed(items[i].substr(0, equals))), std::nullopt};
    if (equals != std::string::npos) {
      const auto value = trimmed(items[i].substr(equals + 1));
      parameter.value = !value.empty() && value[0] == '"' ? value : capitals(value);
    }
    block.parameters.push_back(parameter);
  }
}

} // namespace

std::string capitals(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return out;
}

std::optional<double> as_real(const std::string& item) {
  double value = 0;
  const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
  const bool whole = error == std::errc{} && end == item.data() + item.size();
  if (!whole || !std::isfinite(value) || item.size() > longest_real) return std::nullopt;
  return value;
}

std::optional<long> as_integer(const std::string& item) {
  long value = 0;
  const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), value);
  if (error != std::errc{} || end != item.data() + item.size() || item.size() > longest_integer)
    return std::nullopt;
  return value;
}

bool is_label(const std::string& item) {
  return !item.empty() && item.size() <= 80 && std::isalpha(static_cast<unsigned char>(item[0])) &&
         std::ranges::all_of(item, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

const Parameter* Block::parameter(std::string_view name) const {
  for (const auto& p : parameters)
    if (p.name == name) return &p;
  return nullptr;
}

std::string Block::value(std::string_view name) const {
  const auto* p = parameter(name);
  return p ? p->value.value_or("") : "";
}

std::vector<Block> read_blocks(const std::string& text, Findings& findings) {
  std::vector<Block> blocks;
  std::istringstream lines(text);
  std::string line, keyword_line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.size() > longest_line)
      findings.push_back(
          {number, fmt::format("line of {} characters, allowed are {}", line.size(), longest_line)});
    if (std::ranges::any_of(line, [](unsigned char c) { return c > 126 || (c < 32 && c != '\t'); }))
      findings.push_back({number, "a character that is not plain ASCII"});
    if (line.starts_with("**")) continue;
    const auto content = trimmed(line);
    if (content.starts_with("*") || !keyword_line.empty()) {
      if (keyword_line.empty()) blocks.push_back({{}, number, {}, {}});
      keyword_line += content;
      if (content.ends_with(",")) continue; // goes on in the next line
      read_keyword_line(keyword_line, blocks.back());
      keyword_line.clear();
    } else if (content.empty())
      findings.push_back({number, "a blank line: it is read as data"});
    else if (blocks.empty())
      findings.push_back({number, "data before the first keyword"});
    else
      blocks.back().data.push_back({number, split(content)});
  }
  if (!keyword_line.empty()) findings.push_back({blocks.back().line, "keyword line without an end"});
  return blocks;
}

} // namespace deck
