// SPDX-License-Identifier: BSD-3-Clause
// The checker of decks, against decks spoilt on purpose: each fault is found, at its line.
#include "tests/unit/abaqus_fixture.hpp"
#include <functional>
#include <sstream>

namespace {

using namespace abaqus;
using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Position of the line that is `offset` below the first one that starts with `start`.
std::size_t find(const Lines& lines, const std::string& start, int offset = 0) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].starts_with(start)) return i + std::size_t(offset);
  ADD_FAILURE() << "no line starts with " << start;
  return 0;
}

std::string replaced(std::string line, const std::string& from, const std::string& to) {
  const auto at = line.find(from);
  EXPECT_NE(at, line.npos) << from << " in " << line;
  return at == line.npos ? line : line.replace(at, from.size(), to);
}

struct Fault {
  std::string name;
  std::string start; ///< the fault is made `offset` lines below the line that starts so
  int offset = 0;
  std::string from, to;         ///< replaced there; an empty `from`: the whole line
  std::string found;            ///< part of the finding's text
  std::string reported_at = {}; ///< start of the line that is to be named, if it is another
  int reported_offset = 0;
};

/// Spoils a sound deck and expects a finding at the right line.
void expect_found(const Written& sound, const Fault& fault) {
  auto lines = lines_of(sound.text);
  const auto at = find(lines, fault.start, fault.offset);
  lines[at] = fault.from.empty() ? fault.to : replaced(lines[at], fault.from, fault.to);
  const auto reported =
      fault.reported_at.empty() ? at : find(lines, fault.reported_at, fault.reported_offset);
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  const auto findings = deck::check(text, sound.expected);
  bool found = false;
  for (const auto& f : findings)
    if (f.line == int(reported) + 1 && f.text.find(fault.found) != f.text.npos) found = true;
  EXPECT_TRUE(found) << fault.name << ": expected '" << fault.found << "' at line " << reported + 1
                     << ", found\n"
                     << deck::described(findings);
}

class AbaqusChecker : public testing::Test {
protected:
  static const Written& sound() {
    static const Written deck = written({}, "sound");
    return deck;
  }
  static void expect_all(const std::vector<Fault>& faults) {
    for (const auto& fault : faults) expect_found(sound(), fault);
  }
};

TEST_F(AbaqusChecker, FindsWrongKeywordsAndParameters) {
  expect_all({
      {"unknown keyword", "*DENSITY", 0, "DENSITY", "DENSTY", "unknown keyword"},
      {"unknown parameter", "*SECTION CONTROLS", 0, "KERNEL", "KERNAL", "unknown parameter"},
      {"unknown word", "*SECTION CONTROLS", 0, "CUBIC", "QUARTIC", "KERNEL cannot be"},
      {"missing parameter", "*SOLID SECTION", 0, ", MATERIAL=SIMSAND", "", "no parameter MATERIAL"},
      {"flag with a value", "*DYNAMIC", 0, "EXPLICIT", "EXPLICIT=YES", "takes no value"},
      {"unknown element", "*ELEMENT, TYPE=PC3D", 0, "PC3D", "PC2D", "TYPE cannot be"},
      {"name with a dot", "*MATERIAL", 0, "SIMSAND", "SIM.SAND", "NAME"},
      {"unknown output", "S, SDV", 0, "SDV", "SVD", "unknown variable"},
      {"load before the step", "*STEP", 0, "*STEP, NAME=COLLAPSE, NLGEOM=YES", "** no step",
       "outside of a step", "*DLOAD"},
      {"friction of nothing", "*SURFACE INTERACTION, NAME=SMOOTH", 0, "", "*AMPLITUDE, NAME=B",
       "does not follow", "*SURFACE INTERACTION, NAME=ON_FLOOR", 4},
  });
}

TEST_F(AbaqusChecker, FindsLinesThatCannotBeRead) {
  expect_all({
      {"line too long", "** Bulk", 0, "", "** " + std::string(260, 'x'), "line of 263 characters"},
      {"not ASCII", "** Bulk", 0, "", "** \xc3\xa9", "plain ASCII"},
      {"blank line", "** Bulk", 0, "", "", "blank line"},
      {"not a number", "SAND, GRAV", 0, "9.81", "9.8l", "not a real number"},
      {"number too long", "SAND, GRAV", 0, "9.81", "9.8100000000000000000001", "not a real number"},
      {"decimal comma", "SAND, GRAV", 0, "9.81", "9,81", "7 values on a line"},
      {"node without height", "*NODE, NSET=SAND_NODES", 1, ", 0.005", "", "3 values on a line"},
      {"facet of three corners", "*ELEMENT, TYPE=R3D4, ELSET=WALL", 1, ", ", " ", "values on a line"},
      {"number of constants", "*USER MATERIAL", 0, "14", "13", "CONSTANTS=13, but 14 values"},
      {"constants on a line", "*USER MATERIAL", 1, ", ", ", 1., ", "9 values on a line"},
      {"one state variable more", "*DEPVAR", 1, "5", "6", "6 state variables, the material has 5"},
      {"state that lacks a value", "LAYER_3, 0.4451", 0, ", 0.", "", "4 values on a line, expected 5"},
      {"stress of five components", "LAYER_2, -", 0, ", 0.", "", "6 values on a line"},
      {"times that go back", "*AMPLITUDE", 1, "0., 1., 0.0625", "0., 1., -0.0625", "times do not increase"},
  });
}

TEST_F(AbaqusChecker, FindsNamesThatAreNotThere) {
  expect_all({
      {"section", "*SOLID SECTION", 0, "ELSET=SAND", "ELSET=SANDS", "element set SANDS"},
      {"material", "*SOLID SECTION", 0, "MATERIAL=SIMSAND", "MATERIAL=SAND", "material SAND"},
      {"controls", "*SOLID SECTION", 0, "CONTROLS=PARTICLES", "CONTROLS=PART", "section controls PART"},
      {"surface", "SAND_SURFACE, WALL_SURFACE, SMOOTH", 0, "WALL_SURFACE", "GATE_SURFACE",
       "surface GATE_SURFACE"},
      {"interaction", "SAND_SURFACE, WALL_SURFACE, SMOOTH", 0, "SMOOTH", "ROUGH",
       "surface interaction ROUGH"},
      {"amplitude", "*BOUNDARY, TYPE", 0, "LIFT", "LIFTING", "amplitude LIFTING"},
      {"node set", "FLOOR_REF, 1, 6", 0, "FLOOR_REF", "FLOR_REF", "node set FLOR_REF"},
      {"layer", "LAYER_4, -", 0, "LAYER_4", "LAYER_9", "element set LAYER_9"},
      {"layer of a state", "LAYER_4, 0.", 0, "LAYER_4", "LAYER_9", "element set LAYER_9"},
      {"node of a particle", "*ELEMENT, TYPE=PC3D", 7, "7, 7", "7, 999999", "node 999999"},
      {"member of a layer", "*ELSET, ELSET=LAYER_5", 1, "400", "401", "element 401"},
      {"reference node", "*RIGID BODY, ELSET=WALL", 0, "REF NODE=", "REF NODE=9", "is not defined above"},
      {"output set", "*ELEMENT OUTPUT", 0, "ELSET=SAND", "ELSET=SOIL", "element set SOIL"},
      {"name twice", "*SURFACE INTERACTION, NAME=SMOOTH", 0, "SMOOTH", "ON_FLOOR", "defined twice"},
  });
}

TEST_F(AbaqusChecker, FindsAColumnThatIsNotTheOneMeant) {
  expect_all({
      {"particles too large", "*SOLID SECTION", 1, "", "0.005,", "in a column of"},
      {"length for half length", "*SOLID SECTION", 1, "", "0.00993878505,", "in a column of"},
      {"density of the grains", "*DENSITY", 1, "", "2500.,", "density 2500"},
      {"a constant", "*USER MATERIAL", 2, "1.", "1.1", "constant 11"},
      {"tension", "LAYER_1, -", 0, "", "LAYER_1, 453.076100121, 453.076100121, 763.701473946, 0., 0., 0.",
       "initial stress: component 1"},
      {"vertical axis y", "LAYER_1, -", 0, "",
       "LAYER_1, -453.076100121, -763.701473946, -453.076100121, 0., 0., 0.", "initial stress: component 2"},
      {"layers exchanged", "LAYER_2, -", 0, "LAYER_2", "LAYER_3", "has 0 initial stresses",
       "*ELEMENT, TYPE=PC3D", 81},
      {"shear", "LAYER_5, -", 0, "0., 0., 0.", "0., 9., 0.", "initial stress: component 5"},
      {"void ratio", "LAYER_2, 0.4451", 0, "0.4451", "0.6", "initial state: 0.6"},
      {"particle moved onto another", "*NODE, NSET=SAND_NODES", 2, "", "2, -0.045, -0.015, 0.005",
       "too close", "*ELEMENT, TYPE=PC3D", 2},
      {"particle in the air", "*NODE, NSET=SAND_NODES", 2, "", "2, -0.045, -0.005, 0.5",
       "outside of the column", "*ELEMENT, TYPE=PC3D", 2},
      {"box too small", "*SECTION CONTROLS", 3, "-0.174", "-0.1", "motion leaves it along axis 1"},
      {"box too low", "*SECTION CONTROLS", 3, "0.175", "0.06", "motion leaves it along axis 3"},
      {"box turned over", "*SECTION CONTROLS", 3, "-0.05", "0.5", "axis 3 runs from"},
  });
}

TEST_F(AbaqusChecker, FindsWrongWallsLoadsAndContact) {
  const auto lines = lines_of(sound().text);
  const auto facet = lines[find(lines, "*ELEMENT, TYPE=R3D4, ELSET=WALL", 1)];
  std::istringstream stream(replaced(facet, ",", ""));
  std::array<long, 5> id{};
  for (auto& v : id) {
    stream >> v;
    stream.ignore(1);
  }
  const auto facet_of = [&](int a, int b, int c, int d) {
    return fmt::format("{}, {}, {}, {}, {}", id[0], id[a], id[b], id[c], id[d]);
  };
  const std::string wall = "*ELEMENT, TYPE=R3D4, ELSET=WALL";
  expect_all({
      {"facet turned", wall, 1, "", facet_of(4, 3, 2, 1), "turns its back"},
      {"facet folded", wall, 1, "", facet_of(1, 3, 2, 4), "folded"},
      {"corner twice", wall, 1, "", facet_of(1, 1, 2, 3), "uses a node twice"},
      {"other side", "WALL, SPOS", 0, "SPOS", "SNEG", "turns its back", wall, 1},
      {"no side", "WALL, SPOS", 0, "SPOS", "S1", "SPOS or SNEG"},
      {"floor that tilts", "FLOOR_REF, 1, 6", 0, "6", "3", "3 of 6 degrees", "*RIGID BODY, ELSET=FLOOR"},
      {"no such freedom", "FLOOR_REF, 1, 6", 0, "6", "7", "degrees of freedom 1 to 7"},
      {"wall that moves sideways", "WALL_REF, 3, 3", 0, "3, 3", "1, 1", "the wall is to rise"},
      {"wall that sinks", "WALL_REF, 3, 3", 0, "1.6", "-1.6", "the wall is to rise"},
      {"wall that stops", "*AMPLITUDE", 1, "", "0., 1., 0.01, 1., 0.011, 0., 2., 0.", "the wall stops"},
      {"amplitude too short", "*AMPLITUDE", 1, "", "0., 1., 1., 1.", "ends before the step"},
      {"gravity upwards", "SAND, GRAV", 0, "-1.", "1.", "gravity"},
      {"gravity on one layer", "SAND, GRAV", 0, "SAND", "LAYER_1", "gravity"},
      {"step too short", "*DYNAMIC", 1, "1.5", "0.5", "the step lasts"},
      {"friction", "*FRICTION", 1, "0.5", "0.05", "friction on FLOOR_SURFACE"},
      {"friction on the wall", "SAND_SURFACE, WALL_SURFACE, SMOOTH", 0, "SMOOTH", "ON_FLOOR",
       "friction on WALL_SURFACE", "*FRICTION", 1},
      {"thick particles", "*SURFACE PROPERTY ASSIGNMENT", 1, "0.01", "0.02", "contact begins at"},
      {"wall without contact", "SAND_SURFACE, WALL_SURFACE", 0, "", "** none", "does not meet the sand",
       "*SURFACE, TYPE=ELEMENT, NAME=WALL_SURFACE"},
      {"particles without contact", "SAND_NODES, 1.", 0, "SAND_NODES", "FLOOR_NODES",
       "nodes for 400 particles", "*SURFACE, TYPE=NODE"},
      {"mass scaling", "** Bulk", 0, "", "*FIXED MASS SCALING, FACTOR=100.", "mass scaling"},
  });
}

TEST_F(AbaqusChecker, SaysWhatIsAbsent) {
  auto lines = lines_of(sound().text);
  lines[find(lines, "*END STEP")] = "** end";
  lines[find(lines, "*DLOAD")] = "** load";
  lines[find(lines, "SAND, GRAV")] = "** load";
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  const auto found = deck::described(deck::check(text, sound().expected));
  EXPECT_NE(found.find("line 0: no *DLOAD"), found.npos);
  EXPECT_NE(found.find("line 0: a step without *END STEP"), found.npos);
  EXPECT_NE(deck::described(deck::check("*HEADING\nempty\n", sound().expected)).find("no particles"),
            found.npos);
}

} // namespace
