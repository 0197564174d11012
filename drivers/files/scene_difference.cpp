// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/scene_difference.hpp"
#include <fmt/format.h>
#include <map>
#include <sstream>
#include <toml++/toml.h>

namespace drivers {
namespace {

using Values = std::map<std::string, std::string>;

/// All values below `table` by their dotted names.
void collect(const toml::table& table, const std::string& prefix, Values& values) {
  for (const auto& [key, node] : table) {
    const auto name = prefix + std::string(key.str());
    if (const auto* below = node.as_table()) {
      collect(*below, name + ".", values);
      continue;
    }
    std::stringstream text;
    if (const auto number = node.as_floating_point())
      text << fmt::format("{}", number->get());
    else
      node.visit([&](const auto& value) { text << value; });
    values[name] = text.str();
  }
}

Values values_of(const std::string& scene) {
  Values values;
  collect(toml::parse(std::string_view(scene)), "", values);
  for (const auto* key : {"output.folder", "output.checkpoint_interval", "material.library"})
    values.erase(key);
  return values;
}

std::string shown(const Values& values, const std::string& key) {
  const auto at = values.find(key);
  return at == values.end() ? "absent" : at->second;
}

} // namespace

std::optional<std::string> scene_difference(const std::string& before, const std::string& now) {
  Values old_values, new_values;
  try {
    old_values = values_of(before);
    new_values = values_of(now);
  } catch (const toml::parse_error& error) {
    return fmt::format("expected valid TOML, found an error: {}", error.description());
  }
  Values keys = old_values;
  keys.insert(new_values.begin(), new_values.end());
  for (const auto& [key, value] : keys)
    if (shown(old_values, key) != shown(new_values, key))
      return fmt::format("key '{}': expected {} as in the checkpoint, found {}", key, shown(old_values, key),
                         shown(new_values, key));
  return {};
}

} // namespace drivers
