// SPDX-License-Identifier: BSD-3-Clause
// Whether a deck that reads well is the column it should be.
#pragma once
#include "tests/abaqus/deck_model.hpp"

namespace deck {

/// Blocks of one deck with what they build.
struct Deck {
  const std::vector<Block>& blocks;
  const Model& model;
  const Expected& expected;
  Findings& findings;

  void report(int line, const std::string& text) const { findings.push_back({line, text}); }
  /// The blocks of a keyword, at least one and at most `most`, else a finding.
  std::vector<const Block*> all(const std::string& keyword) const;
  const Block* only(const std::string& keyword) const;
};

/// Value `i` of a data line; 0 where it is empty or no number.
double real_at(const DataLine& line, std::size_t i);
/// |a - b| within `relative` of the larger.
bool close(double a, double b, double relative);

/// Elements PC3D: where they are, what they weigh, what they carry, the box they move in.
void check_particles(const Deck& deck);
/// Rigid facets, their bodies, contact with the sand, what moves and what pulls.
void check_surroundings(const Deck& deck);

} // namespace deck
