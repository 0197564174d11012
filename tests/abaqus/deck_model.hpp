// SPDX-License-Identifier: BSD-3-Clause
// Nodes, elements and names of a deck. Every name must be defined above the line that uses it.
#pragma once
#include "tests/abaqus/deck_reader.hpp"
#include <array>
#include <map>
#include <set>
#include <unordered_map>

namespace deck {

using Point = std::array<double, 3>;

struct Element {
  std::string type;
  std::vector<long> nodes;
  int line = 0;
};

/// A name or number in an element or node position, resolved.
using Members = std::vector<long>;

struct Model {
  std::unordered_map<long, Point> nodes;
  std::map<long, Element> elements;
  std::map<std::string, Members> node_sets, element_sets;
  std::map<std::string, std::set<std::string>> names; ///< by what they name

  /// Members of a set, or the number itself; empty if there is no such set.
  Members elements_of(const std::string& name) const;
  Members nodes_of(const std::string& name) const;
};

Model build_model(const std::vector<Block>& blocks, Findings& findings);

} // namespace deck
