// SPDX-License-Identifier: BSD-3-Clause
// Values and keys as TOML writes them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace drivers {

using Words = std::vector<std::string>;

/// Texts in a row with `separator` between them.
std::string joined(const Words& texts, std::string_view separator = ", ");

/// A number as TOML text that reads back to the same bits, always with a point or exponent.
std::string toml_number(double value);

/// A text in quotes, with what may not stand between them escaped.
std::string quoted_text(std::string_view text);

/// A key as written: bare where TOML allows it.
std::string written_key(std::string_view key);

/// The name of a key in a table; the root's name is empty.
std::string dotted(const std::string& table, std::string_view key);

std::string written(double value);
std::string written(const std::string& value);
std::string written(const std::vector<double>& values);
std::string written(const Words& values);

/// The candidate that `key` may be a misspelling of; empty if none is near.
std::string nearest_word(std::string_view key, const Words& candidates);

} // namespace drivers
