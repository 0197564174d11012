// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/material_file.hpp"
#include "drivers/files/resource.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace drivers {
namespace {

constexpr auto e0_info = simsand::parameters[11];
static_assert(e0_info.key == "e0");

/// A material table over the file it names: the table's own key wins.
struct Sources {
  TomlTable table;
  std::optional<TomlTable> file;
  /// The one of the two that has `key`; without any, the file or else the table, where it is missing.
  const TomlTable& of(std::string_view key) const {
    const bool in_file = file && file->has(key);
    if (in_file && table.has(key)) file->ignore(key);
    return table.has(key) || !(in_file || file) ? table : *file;
  }
};

/// The initial void ratio: of the scene or path, or of the material.
std::optional<double> read_void_ratio(const Sources& sources, std::optional<double> given) {
  const auto& source = sources.of("void_ratio");
  if (!source.has("void_ratio")) return given;
  const double own = source.number("void_ratio", {e0_info.lower, e0_info.upper});
  return given.value_or(own);
}

/// kg/m3: bulk density, given or from that of the grains.
double read_bulk_density(const Sources& sources, std::optional<double> void_ratio, bool grains_required) {
  if (!grains_required && sources.of("density").has("density"))
    return sources.of("density").number("density", positive);
  const double grains = sources.of("grain_density").number("grain_density", positive);
  if (!void_ratio) sources.table.fail("void_ratio", "a number, as grain_density is given", "no such key");
  return grains / (1 + *void_ratio);
}

void read_simsand(const Sources& sources, LoadedMaterial& out) {
  if (!out.void_ratio)
    sources.table.fail("void_ratio", fmt::format("a number from {} to {}", e0_info.lower, e0_info.upper),
                       "no such key");
  if (*out.void_ratio < e0_info.lower || *out.void_ratio > e0_info.upper)
    sources.table.fail("void_ratio", fmt::format("a number from {} to {}", e0_info.lower, e0_info.upper),
                       fmt::format("{}", *out.void_ratio));
  auto& props = out.material.properties;
  for (const auto& info : simsand::parameters) {
    const auto& source = sources.of(info.key);
    const bool optional = !std::isnan(info.fallback_per_p_at);
    if (info.key == e0_info.key)
      props.push_back(*out.void_ratio);
    else if (optional) // a multiple of p_at, which comes before it
      props.push_back(source.number(info.key, {info.lower, info.upper}, info.fallback_per_p_at * props[12]));
    else
      props.push_back(source.number(info.key, {info.lower, info.upper}));
  }
  simsand::Parameters<double> checked;
  if (const auto error = simsand::read_props(props.data(), int(props.size()), checked); error.entry > 0) {
    const auto key = simsand::parameters[error.entry - 1].key;
    sources.of(key).fail(key, "an admissible value",
                         fmt::format("{}, {}", props[error.entry - 1], error.reason));
  }
  for (const auto& state : simsand::state_variables) out.state_names.emplace_back(state.name);
  out.initial_state.assign(out.state_names.size(), 0.0); // zero void ratio: take e0
  out.failure_state = simsand::statev::status;
}

void read_other(const Sources& sources, LoadedMaterial& out) {
  out.material.properties = sources.of("properties").numbers("properties");
  const long states = sources.of("state_variables").integer("state_variables", {0, 10000});
  Words names;
  for (long i = 1; i <= states; ++i) names.push_back(std::to_string(i));
  const auto& named = sources.of("state_names");
  out.state_names = named.texts("state_names", {}, names);
  if (long(out.state_names.size()) != states)
    named.fail("state_names", fmt::format("{} names, one per state variable", states),
               fmt::format("{}", out.state_names.size()));
  out.initial_state = std::vector<double>(states, 0.0);
  if (const auto& initial = sources.of("initial_state"); initial.has("initial_state"))
    out.initial_state = initial.numbers("initial_state", states);
  const auto& failure = sources.of("failure_state");
  if (failure.has("failure_state"))
    out.failure_state = int(failure.integer("failure_state", {1, double(states)})) - 1;
}

/// A library of this project by its bare name, which each program finds anew; else the path of a file.
std::string find_library(const TomlTable& source) {
  const auto name = source.text("library");
  const bool bare = name.find('/') == std::string::npos;
  const auto found = material_library(name);
  if (bare && found != name) return found;
  const auto path = source.path("library");
  if (!bare || std::filesystem::exists(path)) return path;
  return source.text("library");
}

/// How the subroutine is to be called. One of which nothing is known gets all that ABAQUS would give it; SIMSAND
/// is isotropic and looks at neither F nor U.
void read_calling(const Sources& sources, bool is_simsand, host::Material& material) {
  const auto frame =
      sources.of("kinematics")
          .text("kinematics", {"green-naghdi", "jaumann"}, is_simsand ? "jaumann" : "green-naghdi");
  material.frame = frame == "jaumann" ? host::Frame::jaumann : host::Frame::green_naghdi;
  material.serial = sources.of("serial").flag("serial", false);
  material.may_write_inputs = sources.of("may_write_inputs").flag("may_write_inputs", false);
}

} // namespace

LoadedMaterial read_material(const TomlTable& table, std::optional<double> void_ratio) {
  Sources sources{table, std::nullopt};
  if (table.has("file")) sources.file = read_toml(table.path("file"));
  const bool is_simsand = !sources.of("properties").has("properties");

  LoadedMaterial out;
  out.void_ratio = read_void_ratio(sources, void_ratio);
  const auto& named = sources.of("name");
  const auto& located = sources.of("library");
  out.material.name = is_simsand ? named.text("name", {}, "SIMSAND") : named.text("name");
  const auto library =
      is_simsand && !located.has("library") ? material_library("libsimsand_vumat.so") : find_library(located);
  out.is_simsand = is_simsand;
  if (is_simsand)
    read_simsand(sources, out);
  else
    read_other(sources, out);
  read_calling(sources, is_simsand, out.material);
  out.bulk_density = read_bulk_density(sources, out.void_ratio, is_simsand);
  out.material.state_variables = int(out.state_names.size());
  if (sources.file) {
    sources.file->finish();
    table.absorb("file", *sources.file);
  }
  try {
    out.material.library = host::load_vumat(library);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: key 'library': {}", located.where("library"), error.what()));
  }
  return out;
}

} // namespace drivers
