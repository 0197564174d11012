// SPDX-License-Identifier: BSD-3-Clause
// `simsand abaqus`: a scene as an input deck of ABAQUS/Explicit, with the subroutine's source and a page
// on how to run and read it. Manual: drivers/abaqus/ABAQUS.md.
#pragma once
#include "drivers/abaqus/model.hpp"
#include <optional>

namespace drivers {

struct AbaqusOptions {
  std::string folder;
  std::optional<double> spacing; ///< m; default: the scene's
};

inline constexpr const char* abaqus_job = "column";                   ///< deck: column.inp
inline constexpr const char* abaqus_subroutine = "simsand_vumat.cpp"; ///< in the share folder

/// Decks with more particles than this are huge to read and slow to run: a warning.
inline constexpr double many_particles = 500'000;

struct AbaqusSummary {
  std::string deck, page;
  std::size_t particles = 0;
  double edge = 0;          ///< m
  bool with_source = false; ///< the subroutine lies beside the deck
  std::vector<std::string> remarks;
};

/// The deck alone. Throws std::runtime_error for a material name that ABAQUS would not take.
std::string abaqus_deck(const host::Scene& scene, const AbaqusModel& model);

/// Deck, source and page into `options.folder`. Throws std::runtime_error.
AbaqusSummary write_abaqus(const host::Scene& scene, const AbaqusOptions& options);

} // namespace drivers
