// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/abaqus/deck.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <stdexcept>

namespace drivers {
namespace {

/// A number in at most 20 characters with a decimal point.
std::string real(double value) {
  auto text = fmt::format("{:.12g}", value == 0 ? 0.0 : value); // no -0
  if (text.find('.') == text.npos) text.insert(std::min(text.find('e'), text.size()), ".");
  return text;
}

std::string reals(std::initializer_list<double> values) {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : ", ") + real(v);
  return out;
}

/// `first_line` items on the first data line, 8 on each further one.
std::string data_lines(const std::vector<std::string>& items, std::size_t first_line) {
  std::string out;
  std::size_t on_line = 0, room = first_line;
  for (const auto& item : items) {
    if (on_line == room) out += "\n", on_line = 0, room = 8;
    out += (on_line++ ? ", " : "") + item;
  }
  return out + "\n";
}

/// A label: capitals, digits and underscores after a letter.
std::string label(const std::string& text, const std::string& prefix) {
  std::string out;
  for (const unsigned char c : text) out += std::isalnum(c) ? char(std::toupper(c)) : '_';
  return out.empty() || !std::isalpha(static_cast<unsigned char>(out[0])) ? prefix + out : out;
}

/// As a label, and with hyphens.
std::string material_name(const host::Scene& scene) {
  std::string name = scene.material.name;
  for (auto& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
  auto plain = name;
  std::replace(plain.begin(), plain.end(), '-', '_');
  if (name.empty() || name.size() > 80 || label(plain, "X") != plain)
    throw std::runtime_error(fmt::format("material name '{}': ABAQUS takes a letter followed by up to 79 "
                                         "letters, digits, hyphens or underscores",
                                         scene.material.name));
  return name;
}

/// Appends formatted text.
class Deck {
public:
  template <class... T> void operator()(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<T>(values)...);
  }
  std::string text;
};

void particles(Deck& add, const AbaqusModel& m) {
  add("*NODE, NSET=SAND_NODES\n");
  for (std::size_t i = 0; i < m.particles.size(); ++i)
    add("{}, {}\n", i + 1, reals({m.particles[i][0], m.particles[i][1], m.particles[i][2]}));
  add("*ELEMENT, TYPE=PC3D, ELSET=SAND\n");
  for (std::size_t i = 1; i <= m.particles.size(); ++i) add("{}, {}\n", i, i);
  add("** One set for each layer, upwards.\n");
  for (std::size_t k = 0; k < m.layers.size(); ++k)
    add("*ELSET, ELSET=LAYER_{}, GENERATE\n{}, {}, 1\n", k + 1, m.layers[k].first + 1, m.layers[k].last + 1);
}

/// Nodes, facets, reference node and rigid body of a part; `next` is the next free number of nodes and of
/// elements.
void rigid_part(Deck& add, const AbaqusPart& part, std::size_t& next) {
  if (part.facets.empty()) return;
  const std::size_t base = next;
  add("** Rigid part {}: positive normals face the sand.\n*NODE, NSET={}_NODES\n", part.name, part.name);
  for (const auto& p : part.nodes) add("{}, {}\n", next++, reals({p[0], p[1], p[2]}));
  add("*NODE, NSET={}_REF\n{}, {}\n", part.name, next,
      reals({part.reference[0], part.reference[1], part.reference[2]}));
  const std::size_t reference = next++;
  add("*ELEMENT, TYPE=R3D4, ELSET={}\n", part.name);
  std::size_t element = base;
  for (const auto& f : part.facets)
    add("{}, {}, {}, {}, {}\n", element++, base + f[0], base + f[1], base + f[2], base + f[3]);
  next = std::max(next, element);
  add("*RIGID BODY, ELSET={}, REF NODE={}\n", part.name, reference);
  add("*SURFACE, TYPE=ELEMENT, NAME={}_SURFACE\n{}, SPOS\n", part.name, part.name);
}

void section_and_material(Deck& add, const host::Scene& scene, const AbaqusModel& m) {
  const auto name = material_name(scene);
  add("** Data lines 1 and 2 at their defaults; line 3: the box that particles must not leave.\n");
  add("*SECTION CONTROLS, NAME=PARTICLES, KERNEL=CUBIC\n1., 1., 1.\n,\n{}, {}, 0\n",
      reals({m.box_lower[0], m.box_lower[1], m.box_lower[2]}),
      reals({m.box_upper[0], m.box_upper[1], m.box_upper[2]}));
  add("*MATERIAL, NAME={}\n*DENSITY\n{},\n", name, real(scene.bulk_density));
  std::vector<std::string> constants;
  for (const double value : scene.material.properties) constants.push_back(real(value));
  add("*USER MATERIAL, CONSTANTS={}\n{}", constants.size(), data_lines(constants, 8));
  if (!scene.state_names.empty()) add("*DEPVAR\n{},\n", scene.state_names.size());
  for (std::size_t v = 0; v < scene.state_names.size(); ++v)
    add("{}, {}, \"{}\"\n", v + 1, label(scene.state_names[v], "STATE_"),
        label(scene.state_names[v], "STATE_"));
  add("** Half the edge of a particle's cube: {} particles fill the column's {:.9g} m3 exactly.\n",
      m.particles.size(), m.volume);
  add("*SOLID SECTION, ELSET=SAND, MATERIAL={}, CONTROLS=PARTICLES\n{},\n", name, real(0.5 * m.edge));
}

void initial_conditions(Deck& add, const AbaqusModel& m) {
  add("** Components 11, 22, 33, 12, 13, 23; tension positive; 3 is vertical.\n");
  add("*INITIAL CONDITIONS, TYPE=STRESS\n");
  for (std::size_t k = 0; k < m.layers.size(); ++k)
    add("LAYER_{}, {}\n", k + 1,
        reals({m.layers[k].horizontal, m.layers[k].horizontal, m.layers[k].vertical, 0, 0, 0}));
  if (m.layers.front().state.empty()) return;
  add("*INITIAL CONDITIONS, TYPE=SOLUTION\n");
  for (std::size_t k = 0; k < m.layers.size(); ++k) {
    std::vector<std::string> items{fmt::format("LAYER_{}", k + 1)};
    for (const double value : m.layers[k].state) items.push_back(real(value));
    add("{}", data_lines(items, 8)); // the set's name and 7 values
  }
}

void interactions(Deck& add, const host::Scene& scene, const AbaqusModel& m) {
  add("*SURFACE, TYPE=NODE, NAME=SAND_SURFACE\nSAND_NODES, 1.\n");
  add("*SURFACE INTERACTION, NAME=ON_FLOOR\n");
  if (scene.floor.no_slip)
    add("*FRICTION, ROUGH\n");
  else
    add("*FRICTION\n{},\n", real(scene.floor.friction));
  if (!m.wall.facets.empty() || !m.sides.facets.empty())
    add("*SURFACE INTERACTION, NAME=SMOOTH\n*FRICTION\n0.,\n");
}

void boundaries(Deck& add, const host::Scene& scene, const AbaqusModel& m) {
  add("*BOUNDARY\nFLOOR_REF, 1, 6\n");
  if (!m.sides.facets.empty()) add("SIDES_REF, 1, 6\n");
  if (m.wall.facets.empty()) return;
  if (scene.gate.motion == host::GateMotion::fixed) return add("WALL_REF, 1, 6\n");
  add("WALL_REF, 1, 2\nWALL_REF, 4, 6\n");
  // The wall stops once it is far above everything: it need not leave the picture.
  const double stop = 2 * scene.column.height / scene.gate.speed;
  add("*AMPLITUDE, NAME=LIFT, VALUE=RELATIVE\n");
  if (stop < 0.99 * scene.end_time)
    add("{}\n", reals({0, 1, stop, 1, 1.001 * stop, 0, 1.1 * scene.end_time, 0}));
  else
    add("{}\n", reals({0, 1, 1.1 * scene.end_time, 1}));
}

/// General contact between the sand and each part, and no other.
void contact(Deck& add, const AbaqusModel& m) {
  std::vector<std::pair<std::string, std::string>> pairs{{"FLOOR_SURFACE", "ON_FLOOR"}};
  if (!m.wall.facets.empty()) pairs.emplace_back("WALL_SURFACE", "SMOOTH");
  if (!m.sides.facets.empty()) pairs.emplace_back("SIDES_SURFACE", "SMOOTH");
  add("*CONTACT\n*CONTACT INCLUSIONS\n");
  for (const auto& [surface, how] : pairs) add("SAND_SURFACE, {}\n", surface);
  add("*CONTACT PROPERTY ASSIGNMENT\n");
  for (const auto& [surface, how] : pairs) add("SAND_SURFACE, {}, {}\n", surface, how);
  add("** A particle touches where its centre is half of this away; rigid facets have no thickness.\n");
  add("*SURFACE PROPERTY ASSIGNMENT, PROPERTY=THICKNESS\nSAND_SURFACE, {}\n", real(m.rise));
}

void step(Deck& add, const host::Scene& scene, const AbaqusModel& m) {
  add("** Bulk viscosity at its defaults, no mass scaling.\n");
  add("*STEP, NAME=COLLAPSE, NLGEOM=YES\n*DYNAMIC, EXPLICIT\n, {}\n", real(scene.end_time));
  add("*DLOAD\nSAND, GRAV, {}, 0., 0., -1.\n", real(scene.gravity));
  if (scene.gate.motion == host::GateMotion::lift)
    add("*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=LIFT\nWALL_REF, 3, 3, {}\n", real(scene.gate.speed));
  contact(add, m);
  const auto frames = std::max(1L, std::lround(scene.end_time / scene.snapshot_interval));
  add("*OUTPUT, FIELD, NUMBER INTERVAL={}\n*NODE OUTPUT\nU, V\n*ELEMENT OUTPUT, ELSET=SAND\nS, {}DENSITY\n",
      frames, scene.state_names.empty() ? "" : "SDV, ");
  add("*OUTPUT, HISTORY, TIME INTERVAL={}\n", real(scene.sample_interval));
  add("*ENERGY OUTPUT\nALLKE, ALLIE, ALLSE, ALLPD, ALLVD, ALLFD, ALLWK, ETOTAL\n");
  add("*NODE OUTPUT, NSET=FLOOR_REF\nRF1, RF2, RF3\n");
  add("*END STEP\n");
}

} // namespace

std::string abaqus_deck(const host::Scene& scene, const AbaqusModel& m) {
  Deck add;
  add("*HEADING\nColumn of sand, {} particles, written by simsand. SI units, z upwards, tension positive.\n",
      m.particles.size());
  add("*PREPRINT, ECHO=NO, MODEL=NO, HISTORY=NO, CONTACT=NO\n");
  particles(add, m);
  std::size_t next = m.particles.size() + 1;
  for (const auto* part : {&m.floor, &m.wall, &m.sides}) rigid_part(add, *part, next);
  section_and_material(add, scene, m);
  initial_conditions(add, m);
  interactions(add, scene, m);
  boundaries(add, scene, m);
  step(add, scene, m);
  return std::move(add.text);
}

} // namespace drivers
