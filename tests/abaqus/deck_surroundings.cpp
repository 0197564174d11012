// SPDX-License-Identifier: BSD-3-Clause
#include "tests/abaqus/deck_facet.hpp"
#include "tests/abaqus/deck_physics.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace deck {
namespace {

std::optional<Facet> facet_of(const Deck& deck, long id) {
  const auto element = deck.model.elements.find(id);
  if (element == deck.model.elements.end() || element->second.type != "R3D4" ||
      element->second.nodes.size() != 4)
    return std::nullopt;
  std::array<Point, 4> corner;
  for (int i = 0; i < 4; ++i) {
    const auto node = deck.model.nodes.find(element->second.nodes[i]);
    if (node == deck.model.nodes.end()) return std::nullopt;
    corner[i] = node->second;
  }
  return Facet(corner);
}

std::vector<Point> sand_points(const Deck& deck) {
  std::vector<Point> out;
  for (const auto& [id, element] : deck.model.elements)
    if (element.type == "PC3D" && !element.nodes.empty())
      if (const auto node = deck.model.nodes.find(element.nodes[0]); node != deck.model.nodes.end())
        out.push_back(node->second);
  return out;
}

struct Contact {
  std::map<std::string, int> included;                            ///< rigid surfaces that meet the sand: line
  std::map<std::string, std::pair<std::string, int>> interaction; ///< of a rigid surface: name, line
  std::string sand;                                               ///< surface of all particles
  double thickness = 0;
  int thickness_line = 0;
};

const Block* named(const Deck& deck, const std::string& keyword, const std::string& name) {
  for (const auto& block : deck.blocks)
    if (block.keyword == keyword && block.value("NAME") == capitals(name)) return &block;
  return nullptr;
}

Contact read_contact(const Deck& deck, std::size_t particles) {
  Contact contact;
  for (const auto& block : deck.blocks)
    if (block.keyword == "SURFACE" && block.value("TYPE") == "NODE") {
      std::set<long> nodes;
      for (const auto& d : block.data)
        for (const long id : deck.model.nodes_of(d.items.empty() ? "" : d.items[0])) nodes.insert(id);
      contact.sand = block.value("NAME");
      if (nodes.size() != particles)
        deck.report(block.line, fmt::format("surface of {} nodes for {} particles", nodes.size(), particles));
    }
  const auto other = [&](const DataLine& d) -> std::string {
    if (d.items.size() < 2) return "";
    const auto a = capitals(d.items[0]), b = capitals(d.items[1]);
    return a == contact.sand ? b : b == contact.sand ? a : "";
  };
  for (const auto& block : deck.blocks)
    for (const auto& d : block.data) {
      if (block.keyword == "CONTACT INCLUSIONS" && !other(d).empty()) contact.included[other(d)] = d.line;
      if (block.keyword == "CONTACT PROPERTY ASSIGNMENT" && d.items.size() > 2 && !other(d).empty())
        contact.interaction[other(d)] = {d.items[2], d.line};
      if (block.keyword == "SURFACE PROPERTY ASSIGNMENT" && block.value("PROPERTY") == "THICKNESS" &&
          d.items.size() > 1 && capitals(d.items[0]) == contact.sand)
        contact.thickness = real_at(d, 1), contact.thickness_line = d.line;
    }
  return contact;
}

/// Degrees of freedom of a node that are held or driven.
std::set<long> constrained(const Deck& deck, long node) {
  std::set<long> out;
  for (const auto& block : deck.blocks) {
    if (block.keyword != "BOUNDARY") continue;
    for (const auto& d : block.data) {
      const auto nodes = deck.model.nodes_of(d.items.empty() ? "" : d.items[0]);
      if (std::ranges::count(nodes, node) == 0 || d.items.size() < 2) continue;
      const long first = capitals(d.items[1]) == "ENCASTRE" ? 1 : as_integer(d.items[1]).value_or(0);
      const long last = capitals(d.items[1]) == "ENCASTRE"          ? 6
                        : d.items.size() > 2 && !d.items[2].empty() ? as_integer(d.items[2]).value_or(0)
                                                                    : first;
      if (first < 1 || last > 6 || last < first)
        deck.report(d.line, fmt::format("degrees of freedom {} to {}", first, last));
      for (long k = std::max(1L, first); k <= std::min(6L, last); ++k) out.insert(k);
    }
  }
  return out;
}

enum class Role { floor, wall, sides };

/// What a body is to a column that stands on z = 0, told by its normals.
Role role_of(const Facet& facet, bool slab) {
  if (std::abs(facet.normal[2]) > 0.9) return Role::floor;
  return slab && std::abs(facet.normal[1]) > 0.9 ? Role::sides : Role::wall;
}

void check_interaction(const Deck& deck, const Contact& contact, const std::string& surface, int line,
                       Role role) {
  if (!contact.included.contains(surface))
    return deck.report(line, fmt::format("surface {} does not meet the sand", surface));
  const auto found = contact.interaction.find(surface);
  if (found == contact.interaction.end())
    return deck.report(contact.included.at(surface), fmt::format("contact with {} has no property", surface));
  const auto* interaction = named(deck, "SURFACE INTERACTION", found->second.first);
  if (!interaction) return; // reported with the names
  const Block* friction = nullptr;
  for (const Block* b = interaction + 1;
       b < deck.blocks.data() + deck.blocks.size() && b->keyword == "FRICTION"; ++b)
    friction = b;
  const bool rough = friction && friction->parameter("ROUGH");
  const double coefficient = rough                                 ? -1
                             : friction && !friction->data.empty() ? real_at(friction->data[0], 0)
                                                                   : 0;
  const double right = role == Role::floor ? (deck.expected.friction < 0 ? -1 : deck.expected.friction) : 0;
  if (!close(coefficient, right, 1e-9))
    deck.report(friction && !friction->data.empty() ? friction->data[0].line : found->second.second,
                fmt::format("friction on {} is {}, expected {} (-1: rough)", surface, coefficient, right));
}

/// Facets sound and facing the sand, the first particles just touching.
void check_facets(const Deck& deck, const std::vector<Point>& sand, const Contact& contact,
                  const Block& surface, std::set<Role>& roles) {
  Point middle{};
  for (const auto& p : sand)
    for (int c = 0; c < 3; ++c) middle[c] += p[c] / double(sand.size());
  double nearest = 1e300, far = 0;
  Role role = Role::wall;
  for (const auto& d : surface.data)
    for (const long id : deck.model.elements_of(d.items.empty() ? "" : d.items[0])) {
      const auto facet = facet_of(deck, id);
      if (!facet) continue;
      const int line = deck.model.elements.at(id).line;
      if (!facet->sound()) {
        deck.report(line, fmt::format("facet {} is folded, warped or empty", id));
        continue;
      }
      const std::string face = d.items.size() > 1 ? capitals(d.items[1]) : "";
      if (face != "SPOS" && face != "SNEG") deck.report(d.line, "a facet's side is SPOS or SNEG");
      const double side = face == "SNEG" ? -1 : 1;
      if (!(side * dot(facet->normal, minus(middle, facet->centre)) > 0)) {
        deck.report(line, fmt::format("facet {} turns its back to the sand", id));
        continue;
      }
      role = role_of(*facet, deck.expected.slab);
      for (const auto& corner : facet->corner) far = std::max(far, std::abs(corner[0]));
      for (const auto& p : sand)
        if (const auto distance = facet->distance(p)) nearest = std::min(nearest, side * *distance);
    }
  roles.insert(role);
  check_interaction(deck, contact, surface.value("NAME"), surface.line, role);
  if (nearest < 1e300 && !close(nearest, contact.thickness / 2, 1e-4))
    deck.report(contact.thickness_line ? contact.thickness_line : surface.line,
                fmt::format("the sand is {} m from {}, contact begins at {} m", nearest,
                            surface.value("NAME"), contact.thickness / 2));
  if (const auto* controls = role == Role::floor ? deck.only("SECTION CONTROLS") : nullptr;
      controls && controls->data.size() > 2)
    if (far < real_at(controls->data[2], 3) * (1 - 1e-9))
      deck.report(surface.line, "the floor ends inside the tracking box");
}

void check_bodies(const Deck& deck) {
  for (const auto* body : deck.all("RIGID BODY")) {
    const auto elements = deck.model.elements_of(body->value("ELSET"));
    const auto reference = deck.model.nodes_of(body->value("REF NODE"));
    if (reference.size() != 1) {
      deck.report(body->line, "one reference node for a rigid body");
      continue;
    }
    if (const auto held = constrained(deck, reference[0]); held.size() != 6)
      deck.report(body->line,
                  fmt::format("rigid body: {} of 6 degrees of freedom are prescribed", held.size()));
    for (const long id : elements)
      if (const auto element = deck.model.elements.find(id);
          element != deck.model.elements.end() && element->second.type != "R3D4")
        return deck.report(body->line,
                           fmt::format("rigid body with element {} of type {}", id, element->second.type));
  }
  std::set<long> in_bodies;
  for (const auto& block : deck.blocks)
    if (block.keyword == "RIGID BODY")
      for (const long id : deck.model.elements_of(block.value("ELSET"))) in_bodies.insert(id);
  for (const auto& [id, element] : deck.model.elements)
    if (element.type == "R3D4" && !in_bodies.contains(id))
      return deck.report(element.line, fmt::format("facet {} in no rigid body", id));
}

/// Velocity boundary conditions: only the wall's, upwards, on for as long as the sand needs.
void check_lift(const Deck& deck) {
  const auto& e = deck.expected;
  bool lifts = false;
  for (const auto& block : deck.blocks) {
    if (block.keyword != "BOUNDARY" || block.value("TYPE") != "VELOCITY") continue;
    for (const auto& d : block.data) {
      lifts = true;
      if (real_at(d, 1) != 3 || real_at(d, 2) != 3 || !close(real_at(d, 3), e.lift_speed, 1e-9))
        deck.report(d.line, fmt::format("the wall is to rise at {} m/s", e.lift_speed));
    }
    const auto* amplitude = named(deck, "AMPLITUDE", block.value("AMPLITUDE"));
    if (!amplitude || amplitude->data.empty()) continue;
    double integral = 0, time = 0, value = 0, last = 0;
    bool first = true;
    for (const auto& d : amplitude->data)
      for (std::size_t i = 0; i + 1 < d.items.size(); i += 2) {
        last = real_at(d, i);
        if (!first) integral += 0.5 * (last - time) * (value + real_at(d, i + 1));
        time = last, value = real_at(d, i + 1), first = false;
      }
    if (real_at(amplitude->data[0], 0) != 0 || real_at(amplitude->data[0], 1) != 1)
      deck.report(amplitude->data[0].line, "the wall is to rise at full speed from the start");
    if (last < e.end_time) deck.report(amplitude->data[0].line, "the amplitude ends before the step");
    if (e.lift_speed * integral < std::min(1.5 * e.height, e.lift_speed * e.end_time))
      deck.report(amplitude->data[0].line, "the wall stops within reach of the sand");
  }
  if (!lifts && e.lift_speed > 0) deck.report(0, "nothing lifts the wall");
}

void check_step(const Deck& deck, std::size_t particles) {
  const auto& e = deck.expected;
  deck.only("STEP");
  if (const auto* dynamic = deck.only("DYNAMIC"); dynamic && !dynamic->data.empty())
    if (!close(real_at(dynamic->data[0], 1), e.end_time, 1e-9))
      deck.report(dynamic->data[0].line, fmt::format("the step lasts {} s instead of {} s",
                                                     real_at(dynamic->data[0], 1), e.end_time));
  if (const auto* load = deck.only("DLOAD"))
    for (const auto& d : load->data) {
      const bool whole =
          d.items.empty() || d.items[0].empty() || deck.model.elements_of(d.items[0]).size() == particles;
      const double size = std::sqrt(real_at(d, 3) * real_at(d, 3) + real_at(d, 4) * real_at(d, 4) +
                                    real_at(d, 5) * real_at(d, 5));
      if (!whole || d.items.size() < 6 || capitals(d.items[1]) != "GRAV" ||
          !close(real_at(d, 2) * real_at(d, 5), -e.gravity, 1e-9) || !close(size, 1, 1e-9))
        deck.report(d.line, "gravity is to pull all particles down");
    }
  for (const auto& block : deck.blocks)
    if (block.keyword.ends_with("MASS SCALING")) deck.report(block.line, "mass scaling");
  std::set<std::string> outputs;
  for (const auto& block : deck.blocks)
    if (block.keyword.ends_with(" OUTPUT"))
      for (const auto& d : block.data)
        for (const auto& item : d.items) outputs.insert(capitals(item));
  for (const char* wanted : {"U", "S", "ALLKE", "ALLIE"})
    if (!outputs.contains(wanted)) deck.report(0, fmt::format("no output of {}", wanted));
  if (e.state_variables > 0 && !outputs.contains("SDV")) deck.report(0, "no output of SDV");
}

} // namespace

void check_surroundings(const Deck& deck) {
  const auto sand = sand_points(deck);
  const auto contact = read_contact(deck, sand.size());
  deck.only("CONTACT");
  std::set<Role> roles;
  for (const auto& block : deck.blocks)
    if (block.keyword == "SURFACE" && block.value("TYPE") != "NODE")
      check_facets(deck, sand, contact, block, roles);
  if (!roles.contains(Role::floor)) deck.report(0, "no floor");
  if (roles.contains(Role::wall) != deck.expected.wall)
    deck.report(0, deck.expected.wall ? "no wall" : "a wall");
  if (roles.contains(Role::sides) != deck.expected.slab)
    deck.report(0, deck.expected.slab ? "no sides" : "sides");
  check_bodies(deck);
  check_lift(deck);
  check_step(deck, sand.size());
}

} // namespace deck
