// SPDX-License-Identifier: BSD-3-Clause
#include "tests/abaqus/deck_check.hpp"
#include "tests/abaqus/deck_physics.hpp"
#include "tests/abaqus/deck_rules.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace deck {

std::vector<const Block*> Deck::all(const std::string& keyword) const {
  std::vector<const Block*> out;
  for (const auto& block : blocks)
    if (block.keyword == keyword) out.push_back(&block);
  if (out.empty()) report(0, fmt::format("no *{}", keyword));
  return out;
}

const Block* Deck::only(const std::string& keyword) const {
  const auto found = all(keyword);
  if (found.size() > 1) report(found[1]->line, fmt::format("a second *{}", keyword));
  return found.empty() ? nullptr : found[0];
}

double real_at(const DataLine& line, std::size_t i) {
  return i < line.items.size() ? as_real(line.items[i]).value_or(0) : 0;
}

bool close(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

Findings check(const std::string& text, const Expected& expected) {
  Findings findings;
  const auto blocks = read_blocks(text, findings);
  check_syntax(blocks, findings);
  const auto model = build_model(blocks, findings);
  const Deck deck{blocks, model, expected, findings};
  check_particles(deck);
  check_surroundings(deck);
  std::ranges::stable_sort(findings, {}, &Finding::line);
  return findings;
}

std::string described(const Findings& findings) {
  std::string out;
  for (const auto& f : findings) out += fmt::format("line {}: {}\n", f.line, f.text);
  return out;
}

} // namespace deck
