// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/resume.hpp"
#include "drivers/files/scene_difference.hpp"
#include "drivers/files/scene_file.hpp"
#include "drivers/run/build_hash.hpp"
#include "drivers/version.hpp"
#include "host/files/result_read.hpp"
#include "host/files/seal.hpp"
#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace drivers {
namespace {

namespace fs = std::filesystem;

struct Found {
  fs::path path;
  host::CheckpointHeader header;
};

/// The newest of the checkpoints that can be read.
Found latest_readable(const fs::path& folder) {
  const auto newest = checkpoint_path(folder), previous = previous_checkpoint_path(folder);
  if (!fs::exists(newest) && !fs::exists(previous))
    throw std::runtime_error(fmt::format("{}: no checkpoint to resume from", folder.string()));
  try {
    return {newest, host::verified_checkpoint(newest)};
  } catch (const std::runtime_error& first) {
    if (!fs::exists(previous)) throw;
    Found found{previous, host::verified_checkpoint(previous)};
    spdlog::warn("{}; going on from the one before, at {:.6g} s", first.what(), found.header.time);
    return found;
  }
}

/// The scene as text, if the file holds one: a run can go on without, from the one in its checkpoint.
std::optional<std::string> stored_text(const fs::path& path) {
  if (!fs::exists(path)) return {};
  try {
    return read_scene(path.string()).resolved;
  } catch (const std::runtime_error& error) {
    spdlog::warn("{}; going on with the scene in the checkpoint", error.what());
    return {};
  }
}

/// Refuses a checkpoint that another program wrote, and another scene than the stored one.
void check(const Found& found, const std::optional<std::string>& scene, const std::string& scene_name) {
  const auto& header = found.header;
  if (header.version != version)
    throw std::runtime_error(fmt::format("{}: written by simsand {}, this is {}: only the same version makes "
                                         "the same numbers",
                                         found.path.string(), header.version, version));
  if (header.compiler != compiler)
    spdlog::warn("{}: written by a program built with {}, this one with {}: the last digits may differ",
                 found.path.string(), header.compiler, compiler);
  if (!scene) return;
  if (const auto difference = scene_difference(header.scene, *scene))
    throw std::runtime_error(
        fmt::format("{}: {}; a run goes on only with the scene it began with", scene_name, *difference));
}

void check_library(const Found& found, const host::Scene& scene) {
  if (file_hash(scene.material.library.path) != found.header.library_hash)
    spdlog::warn("{}: the material library has changed since {} was written: the numbers may differ from "
                 "those of an uninterrupted run",
                 scene.material.library.path, found.path.string());
}

/// The folder that `what` names or lies in.
fs::path folder_of(const fs::path& what) {
  if (fs::is_directory(what)) return what;
  return what.has_parent_path() ? what.parent_path() : fs::path(".");
}

} // namespace

fs::path checkpoint_path(const fs::path& folder) {
  return folder / "checkpoint.h5";
}

fs::path previous_checkpoint_path(const fs::path& folder) {
  return folder / "checkpoint_previous.h5";
}

std::optional<Resumption> find_resumption(const std::string& what, const std::string& given_folder,
                                          const std::vector<std::string>& settings) {
  if (!fs::exists(what)) throw std::runtime_error(fmt::format("{}: no such file or folder", what));
  const bool is_scene = !fs::is_directory(what) && fs::path(what).extension() != ".h5";
  Resumption resumption;
  std::optional<std::string> expected;
  fs::path folder;
  std::string scene_name = what;
  if (is_scene) {
    resumption.scene = read_scene(what, settings);
    expected = resumption.scene.resolved;
    folder = given_folder.empty() ? resumption.scene.output_folder : given_folder;
  } else {
    if (!settings.empty())
      throw std::runtime_error(
          fmt::format("--set {}: expected a scene file beside it, found {}, which has its scene with it",
                      settings.front(), what));
    folder = folder_of(what);
    scene_name = (folder / "scene.toml").string();
    expected = stored_text(scene_name);
  }
  if (const auto result = folder / "result.h5"; fs::exists(result) && !host::has_intact_seal(result))
    spdlog::warn("{}: damaged or cut short; what it held is written again from the checkpoint",
                 result.string());
  if (host::is_complete_result(folder / "result.h5")) {
    remove_checkpoints(folder);
    fs::remove_all(
        host::parts_folder(folder / "result.h5")); // of a run that was killed while it became complete
    return {};
  }
  const auto found = latest_readable(folder);
  check(found, expected, scene_name);
  if (!is_scene) resumption.scene = read_scene(found.path.string());
  check_library(found, resumption.scene);
  resumption.scene.output_folder = folder.string();
  resumption.scene.resolved = found.header.scene;
  resumption.checkpoint = found.path;
  return resumption;
}

host::CheckpointHeader header_of(const host::Scene& scene) {
  const auto& library = scene.material.library.path;
  const std::string geometry = host::with_geometry(scene.geometry, [](auto g) { return g.name; });
  return {scene.resolved, version, compiler, geometry, library, file_hash(library)};
}

void remove_newer_checkpoint(const fs::path& read) {
  const auto newest = checkpoint_path(folder_of(read));
  std::error_code ignored;
  if (read.filename() != newest.filename()) fs::remove(newest, ignored);
}

bool remove_checkpoints(const fs::path& folder) {
  std::error_code ignored;
  const bool newest = fs::remove(checkpoint_path(folder), ignored);
  return fs::remove(previous_checkpoint_path(folder), ignored) || newest;
}

} // namespace drivers
