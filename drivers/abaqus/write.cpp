// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/abaqus/deck.hpp"
#include "drivers/abaqus/page.hpp"
#include "drivers/files/resource.hpp"
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

namespace drivers {
namespace {

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

} // namespace

AbaqusSummary write_abaqus(const host::Scene& scene, const AbaqusOptions& options) {
  namespace fs = std::filesystem;
  const double spacing = options.spacing.value_or(scene.spacing);
  if (!(spacing >= scene.spacing))
    throw std::runtime_error(
        fmt::format("--spacing {}: expected the scene's {} m or coarser", spacing, scene.spacing));
  const double count = abaqus_particle_count(scene, spacing);
  constexpr double too_many = 5e7; // gigabytes of text
  if (count > too_many)
    throw std::runtime_error(
        fmt::format("a spacing of {} m makes {:.2g} particles: give a coarser --spacing", spacing, count));
  const auto model = make_abaqus_model(scene, spacing);
  const auto deck = abaqus_deck(scene, model);

  const fs::path folder = options.folder;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", options.folder, error.message()));
  AbaqusSummary summary;
  summary.particles = model.particles.size();
  summary.edge = model.edge;
  const bool own = scene.friction_angle > 0;
  if (const auto source = find_resource(fmt::format("abaqus/{}", abaqus_subroutine));
      own && !source.empty()) {
    fs::copy_file(source, folder / abaqus_subroutine, fs::copy_options::overwrite_existing, error);
    if (error)
      throw std::runtime_error(
          fmt::format("{}: cannot be written: {}", (folder / abaqus_subroutine).string(), error.message()));
    summary.with_source = true;
  }
  summary.deck = (folder / fmt::format("{}.inp", abaqus_job)).string();
  summary.page = (folder / "README.md").string();
  write_file(summary.deck, deck);
  write_file(summary.page, abaqus_page(scene, model, summary.with_source));
  if (count > many_particles)
    summary.remarks.push_back(fmt::format(
        "{} particles: a coarser --spacing makes a deck that ABAQUS reads sooner", summary.particles));
  if (own && !summary.with_source)
    summary.remarks.push_back(
        fmt::format("the program comes without {}: see {}", abaqus_subroutine, summary.page));
  if (scene.gate.motion == host::GateMotion::remove)
    summary.remarks.push_back("the scene removes the wall at once: the deck has none");
  return summary;
}

} // namespace drivers
