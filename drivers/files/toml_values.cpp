// SPDX-License-Identifier: BSD-3-Clause
// The values of a table: what is accepted, what is said of what is not, and how it is written.
#include "drivers/files/toml_document.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace drivers {
namespace {

std::string described(Range r) {
  const bool below = std::isfinite(r.lower), above = std::isfinite(r.upper),
             beyond_zero = r.lower == positive.lower;
  if (beyond_zero && above) return fmt::format(" above 0 and at most {}", r.upper);
  if (beyond_zero) return " above 0";
  if (below && above) return fmt::format(" from {} to {}", r.lower, r.upper);
  if (below) return fmt::format(" of at least {}", r.lower);
  return above ? fmt::format(" of at most {}", r.upper) : "";
}

std::string described(const Words& words) {
  if (words.empty()) return "a text";
  Words quotes;
  for (const auto& w : words) quotes.push_back(quoted_text(w));
  return fmt::format("{}{}", words.size() > 1 ? "one of " : "", joined(quotes));
}

std::optional<double> number_in(const toml::node& node, Range range) {
  const auto value = node.value<double>();
  const bool is_number = node.is_number() && value && std::isfinite(*value);
  return is_number && *value >= range.lower && *value <= range.upper ? value : std::nullopt;
}

std::optional<std::string> word_in(const toml::node& node, const Words& words) {
  const auto value = node.value_exact<std::string>();
  const bool allowed =
      words.empty() || (value && std::find(words.begin(), words.end(), *value) != words.end());
  return allowed ? value : std::nullopt;
}

} // namespace

double TomlTable::number(std::string_view key, Range range, std::optional<double> fallback) const {
  return node->value<double>(
      *this, key, fallback, "a number" + described(range),
      [&](const toml::node& n) { return number_in(n, range); }, toml_number);
}

long TomlTable::integer(std::string_view key, Range range, std::optional<long> fallback) const {
  return node->value<long>(
      *this, key, fallback, "an integer" + described(range),
      [&](const toml::node& n) {
        return n.is_integer() && number_in(n, range) ? std::optional<long>(n.value<long>()) : std::nullopt;
      },
      [](long v) { return fmt::format("{}", v); });
}

bool TomlTable::flag(std::string_view key, std::optional<bool> fallback) const {
  return node->value<bool>(
      *this, key, fallback, "true or false", [](const toml::node& n) { return n.value_exact<bool>(); },
      [](bool v) { return v ? "true" : "false"; });
}

std::string TomlTable::text(std::string_view key, const Words& words,
                            std::optional<std::string> fallback) const {
  return node->value<std::string>(
      *this, key, fallback, described(words), [&](const toml::node& n) { return word_in(n, words); },
      quoted_text);
}

NumberOrWord TomlTable::number_or_word(std::string_view key, Range range, const Words& words,
                                       std::optional<NumberOrWord> fallback) const {
  return node->value<NumberOrWord>(
      *this, key, fallback, fmt::format("a number{} or {}", described(range), described(words)),
      [&](const toml::node& n) -> std::optional<NumberOrWord> {
        if (const auto number = number_in(n, range)) return *number;
        if (const auto word = word_in(n, words)) return *word;
        return std::nullopt;
      },
      [](const NumberOrWord& v) { return std::visit([](const auto& x) { return written(x); }, v); });
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, Range range,
                                       std::optional<std::vector<double>> fallback) const {
  const auto expected = fmt::format("an array of {}numbers{}", count ? fmt::format("{} ", count) : "",
                                    range.lower == any_number.lower ? "" : ", each" + described(range));
  return node->value<std::vector<double>>(
      *this, key, fallback, expected,
      [&](const toml::node& n) -> std::optional<std::vector<double>> {
        const auto* array = n.as_array();
        if (!array || (count && array->size() != count)) return std::nullopt;
        std::vector<double> values;
        for (const auto& element : *array)
          if (const auto v = number_in(element, range))
            values.push_back(*v);
          else
            fail(key, expected, fmt::format("element {}: {}", values.size() + 1, shown(element)));
        return values;
      },
      [](const std::vector<double>& v) { return written(v); });
}

Words TomlTable::texts(std::string_view key, const Words& words, std::optional<Words> fallback) const {
  const auto expected = words.empty() ? "an array of texts" : "an array, each element " + described(words);
  return node->value<Words>(
      *this, key, fallback, expected,
      [&](const toml::node& n) -> std::optional<Words> {
        const auto* array = n.as_array();
        if (!array) return std::nullopt;
        Words values;
        for (const auto& element : *array)
          if (const auto v = word_in(element, words))
            values.push_back(*v);
          else
            fail(key, expected, fmt::format("element {}: {}", values.size() + 1, shown(element)));
        return values;
      },
      [](const Words& v) { return written(v); });
}

std::string TomlTable::path(std::string_view key, std::optional<std::string> fallback) const {
  const auto given = text(key, {}, std::move(fallback));
  if (given.empty()) fail(key, "a path", "\"\"");
  const auto resolved = std::filesystem::absolute(node->document->folder / given).lexically_normal().string();
  node->record(key, quoted_text(resolved));
  return resolved;
}

} // namespace drivers
