// SPDX-License-Identifier: BSD-3-Clause
// `simsand abaqus`: a scene as a deck for ABAQUS/Explicit.
#include "drivers/abaqus/deck.hpp"
#include "drivers/files/scene_file.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <spdlog/spdlog.h>

namespace commands {
namespace {

struct Options {
  std::string file;
  drivers::AbaqusOptions deck;
};

} // namespace

void add_abaqus(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("abaqus", "Write an ABAQUS/Explicit deck of a scene");
  command
      ->add_option("SCENE", options->file,
                   "scene file (.toml), or a result file (.h5); manual: drivers/abaqus/ABAQUS.md")
      ->required();
  command->add_option("-o,--output", options->deck.folder, "folder for the deck, the subroutine and a page")
      ->required();
  command->add_option("--spacing", options->deck.spacing,
                      "distance of particles, m: the scene's (default) or coarser");
  command->callback([options] {
    const auto summary = drivers::write_abaqus(drivers::read_scene(options->file), options->deck);
    for (const auto& remark : summary.remarks) spdlog::warn("{}", remark);
    fmt::print("{} particles of {:.4g} mm: {}, {}\n", summary.particles, 1e3 * summary.edge, summary.deck,
               summary.page);
  });
}

} // namespace commands
