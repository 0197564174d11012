// SPDX-License-Identifier: BSD-3-Clause
#include "tests/abaqus/deck_physics.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace deck {
namespace {

struct Particle {
  long element;
  Point at;
  int line;
};

std::vector<Particle> particles_of(const Deck& deck) {
  std::vector<Particle> out;
  for (const auto& [id, element] : deck.model.elements) {
    if (element.type != "PC3D" || element.nodes.size() != 1) continue;
    const auto node = deck.model.nodes.find(element.nodes[0]);
    if (node != deck.model.nodes.end()) out.push_back({id, node->second, element.line});
  }
  return out;
}

double column_volume(const Expected& e, double depth) {
  return e.height * (e.slab ? 2 * e.radius * depth : std::numbers::pi * e.radius * e.radius);
}

/// Extent along y: particles of the first row at the spacing of the second stand for the slab.
double slab_depth(const std::vector<Particle>& particles) {
  std::vector<double> y;
  for (const auto& p : particles) y.push_back(p.at[1]);
  std::ranges::sort(y);
  y.erase(
      std::unique(y.begin(), y.end(), [](double a, double b) { return b - a < 1e-9 + 1e-6 * std::abs(b); }),
      y.end());
  return y.size() > 1 ? (y.back() - y.front()) * double(y.size()) / double(y.size() - 1) : 0;
}

/// Half the edge of each particle's cube; every particle in one section; the whole volume.
double check_volume(const Deck& deck, const std::vector<Particle>& particles) {
  std::map<long, int> sections;
  double volume = 0, half_edge = 0;
  int line = 0;
  for (const auto* block : deck.all("SOLID SECTION")) {
    if (block->data.empty()) continue;
    line = block->data[0].line;
    half_edge = real_at(block->data[0], 0);
    if (!(half_edge > 0)) deck.report(line, "a characteristic length that is not positive");
    for (const long id : deck.model.elements_of(block->value("ELSET"))) {
      ++sections[id];
      volume += std::pow(2 * half_edge, 3);
    }
  }
  for (const auto& p : particles)
    if (sections[p.element] != 1) {
      deck.report(p.line, fmt::format("particle {} in {} sections", p.element, sections[p.element]));
      break;
    }
  if (const double whole = column_volume(deck.expected, slab_depth(particles)); !close(volume, whole, 1e-6))
    deck.report(line, fmt::format("particles of {} m3 in a column of {} m3", volume, whole));
  return half_edge;
}

/// Inside the column, centred on it, none too near to another.
void check_places(const Deck& deck, const std::vector<Particle>& particles, double half_edge) {
  const auto& e = deck.expected;
  std::map<std::array<long, 3>, std::vector<const Particle*>> cells;
  const double edge = 2 * half_edge, least = 0.85 * edge;
  Point mean{};
  for (const auto& p : particles) {
    const double out = e.slab ? std::abs(p.at[0]) : std::hypot(p.at[0], p.at[1]);
    if (out > e.radius || p.at[2] < 0 || p.at[2] > e.height)
      return deck.report(p.line, fmt::format("particle {} is outside of the column", p.element));
    std::array<long, 3> cell{};
    for (int c = 0; c < 3; ++c)
      cell[c] = std::lround(std::floor(p.at[c] / edge)), mean[c] += p.at[c] / double(particles.size());
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        for (long k = -1; k <= 1; ++k)
          if (const auto near = cells.find({cell[0] + i, cell[1] + j, cell[2] + k}); near != cells.end())
            for (const auto* q : near->second)
              if (std::hypot(p.at[0] - q->at[0], p.at[1] - q->at[1], p.at[2] - q->at[2]) < least)
                return deck.report(p.line,
                                   fmt::format("particles {} and {} are too close", q->element, p.element));
    cells[cell].push_back(&p);
  }
  if (std::abs(mean[0]) > 1e-6 * e.radius || (!e.slab && std::abs(mean[1]) > 1e-6 * e.radius) ||
      !close(mean[2], e.height / 2, 1e-6))
    deck.report(0, "the particles' centre is not that of the column");
}

/// 11, 22, 33, 12, 13, 23 from the weight above, compression negative, once for each particle.
void check_stress(const Deck& deck, const std::vector<Particle>& particles) {
  const auto& e = deck.expected;
  std::map<long, std::pair<const DataLine*, int>> given;
  for (const auto& block : deck.blocks)
    if (block.keyword == "INITIAL CONDITIONS" && block.value("TYPE") == "STRESS")
      for (const auto& data : block.data)
        for (const long id : deck.model.elements_of(data.items.empty() ? "" : data.items[0])) {
          given[id].first = &data;
          ++given[id].second;
        }
  std::set<int> reported;
  for (const auto& p : particles) {
    const auto found = given.find(p.element);
    if (found == given.end() || found->second.second != 1)
      return deck.report(found == given.end() ? p.line : found->second.first->line,
                         fmt::format("particle {} has {} initial stresses", p.element,
                                     found == given.end() ? 0 : found->second.second));
    const auto& line = *found->second.first;
    const double vertical = e.density * e.gravity * (p.at[2] - e.height);
    const std::array<double, 6> right{
        e.pressure_ratio * vertical, e.pressure_ratio * vertical, vertical, 0, 0, 0};
    for (std::size_t c = 0; c < 6; ++c)
      if (!close(real_at(line, c + 1), right[c], 1e-6) && reported.insert(line.line).second)
        deck.report(line.line, fmt::format("initial stress: component {} is {}, the weight above makes {}",
                                           c + 1, real_at(line, c + 1), right[c]));
  }
}

/// The set or element and 7 values on the first line, 8 on each further one, until all are given.
void check_state(const Deck& deck, const std::vector<Particle>& particles) {
  const auto& e = deck.expected;
  std::size_t variables = 0;
  if (const auto* depvar = e.state_variables ? deck.only("DEPVAR") : nullptr) {
    variables = std::size_t(depvar->data.empty() ? 0 : real_at(depvar->data[0], 0));
    if (variables != e.state_variables)
      deck.report(depvar->data.empty() ? depvar->line : depvar->data[0].line,
                  fmt::format("{} state variables, the material has {}", variables, e.state_variables));
  }
  std::set<long> given;
  for (const auto& block : deck.blocks) {
    if (block.keyword != "INITIAL CONDITIONS" || block.value("TYPE") != "SOLUTION") continue;
    std::size_t got = 0;
    std::string name;
    int start = block.line;
    for (const auto& data : block.data) {
      const bool first = got == 0;
      if (first) {
        start = data.line;
        name = data.items.empty() ? "" : data.items[0];
        const auto members = deck.model.elements_of(name);
        if (members.empty()) deck.report(data.line, fmt::format("element set {} is not defined above", name));
        for (const long id : members)
          if (!given.insert(id).second) {
            deck.report(data.line, fmt::format("a second initial state for element {}", id));
            break;
          }
      }
      const std::size_t values = data.items.size() - first, left = variables - got;
      const std::size_t room = first ? 7 : 8;
      if (values != std::min(left, room))
        deck.report(data.line, fmt::format("initial state: {} values on a line, expected {}", values,
                                           std::min(left, room)));
      for (std::size_t i = first; i < data.items.size(); ++i)
        if (!as_real(data.items[i]))
          deck.report(data.line, fmt::format("initial state: {} is no number", data.items[i]));
      if (first && e.first_state == e.first_state && !close(real_at(data, 1), e.first_state, 1e-9))
        deck.report(data.line,
                    fmt::format("initial state: {} instead of {}", real_at(data, 1), e.first_state));
      got += std::min(left, room);
      if (got >= variables) got = 0;
    }
    if (got != 0) deck.report(start, "initial state: lines are missing");
  }
  for (const auto& p : particles)
    if (variables > 0 && !given.contains(p.element))
      return deck.report(p.line, fmt::format("particle {} has no initial state", p.element));
}

/// Holds the column, its expected runout and half a column of room above.
void check_box(const Deck& deck) {
  const auto* controls = deck.only("SECTION CONTROLS");
  if (!controls) return;
  if (controls->data.size() < 3) return deck.report(controls->line, "no tracking box on a third data line");
  const auto& data = controls->data[2];
  const auto& e = deck.expected;
  // Lube et al. 2004 (cylinders), 2005 (channels), the larger of the two branches.
  const double a = e.height / e.radius;
  const double runout =
      e.slab ? std::max(1.2 * a, 1.9 * std::cbrt(a * a)) : std::max(1.24 * a, 1.6 * std::sqrt(a));
  const double far = e.radius * (1 + runout);
  for (std::size_t c = 0; c < 3; ++c) {
    const double lower = real_at(data, c), upper = real_at(data, c + 3);
    if (!(lower < upper))
      deck.report(data.line, fmt::format("tracking box: axis {} runs from {} to {}", c + 1, lower, upper));
    const bool holds = c == 2             ? lower < 0 && upper >= 1.4 * e.height
                       : c == 1 && e.slab ? lower < 0 && upper > 0
                                          : lower <= -far && upper >= far;
    if (!holds) deck.report(data.line, fmt::format("tracking box: motion leaves it along axis {}", c + 1));
  }
  for (const auto& [id, element] : deck.model.elements) {
    if (element.type != "PC3D" || element.nodes.empty() || !deck.model.nodes.contains(element.nodes[0]))
      continue;
    const auto& p = deck.model.nodes.at(element.nodes[0]);
    for (std::size_t c = 0; c < 3; ++c)
      if (p[c] <= real_at(data, c) || p[c] >= real_at(data, c + 3))
        return deck.report(data.line, fmt::format("tracking box: particle {} starts outside", id));
  }
}

void check_material(const Deck& deck) {
  const auto& e = deck.expected;
  if (const auto* density = deck.only("DENSITY"); density && !density->data.empty())
    if (!close(real_at(density->data[0], 0), e.density, 1e-9))
      deck.report(density->data[0].line,
                  fmt::format("density {} instead of {}", real_at(density->data[0], 0), e.density));
  const auto* material = deck.only("USER MATERIAL");
  if (!material) return;
  std::size_t i = 0;
  for (const auto& data : material->data)
    for (std::size_t k = 0; k < data.items.size(); ++k, ++i)
      if (i >= e.constants.size() || !close(real_at(data, k), e.constants[i], 1e-10))
        return deck.report(data.line, fmt::format("constant {} is {}", i + 1, data.items[k]));
  if (i != e.constants.size())
    deck.report(material->line, fmt::format("{} constants, the material has {}", i, e.constants.size()));
}

} // namespace

void check_particles(const Deck& deck) {
  const auto particles = particles_of(deck);
  if (particles.empty()) return deck.report(0, "no particles");
  const double half_edge = check_volume(deck, particles);
  if (half_edge > 0) check_places(deck, particles, half_edge);
  check_stress(deck, particles);
  check_state(deck, particles);
  check_box(deck);
  check_material(deck);
}

} // namespace deck
