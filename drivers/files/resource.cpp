// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/resource.hpp"
#include "drivers/layout.hpp"
#include "host/material/library.hpp"
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

std::string built_share() {
  return host::beside_program("share/simsand");
}

std::string installed_share() {
  return fs::path(host::beside_program(layout::share)).lexically_normal().string();
}

/// Empty if there is none.
std::string find_share() {
  if (const char* given = std::getenv("SIMSAND_SHARE")) return given;
  for (const auto& folder : {built_share(), installed_share()})
    if (fs::is_directory(folder)) return folder;
  return {};
}

} // namespace

std::string share_folder() {
  const auto folder = find_share();
  if (folder.empty())
    throw std::runtime_error(fmt::format(
        "no folder of data and scripts: neither {} nor {}; SIMSAND_SHARE=FOLDER names another place",
        built_share(), installed_share()));
  if (!fs::is_directory(folder))
    throw std::runtime_error(fmt::format("SIMSAND_SHARE={}: no such folder", folder));
  return folder;
}

std::string resource(const std::string& name) {
  const auto path = (fs::path(share_folder()) / name).string();
  if (!fs::exists(path)) throw std::runtime_error(fmt::format("{}: no such file", path));
  return path;
}

std::string find_resource(const std::string& name) {
  const auto folder = find_share();
  const auto path = fs::path(folder) / name;
  return !folder.empty() && fs::exists(path) ? path.string() : "";
}

std::string data_folder() {
  return share_folder();
}

std::string material_library(const std::string& name) {
  for (const auto& place :
       {host::beside_program(name), host::beside_program(fmt::format("{}/{}", layout::lib, name))})
    if (fs::exists(place)) return place;
  return name;
}

} // namespace drivers
