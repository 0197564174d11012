// SPDX-License-Identifier: BSD-3-Clause
// Keywords of ABAQUS/Explicit that a deck of particles and rigid facets can need, as the keywords guide
// describes them. A pattern gives the kinds of the items of a data line: i positive integer, r real, l label,
// k label or positive integer, w word or label (blanks allowed), t any text; capitals may be left empty; `+`
// repeats the last kind. `least` items must be there.
#include "tests/abaqus/deck_rules.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace deck {
namespace {

enum class Place { model, step, either };
constexpr int any_number = 1 << 30;

struct ParameterRule {
  std::string name;
  bool required = false;
  std::string kind = "";               ///< as in patterns; "": a flag
  std::vector<std::string> words = {}; ///< allowed values; none: any of the kind
};

struct Rule {
  Place place;
  std::string under; ///< keyword that this one belongs to
  std::vector<ParameterRule> parameters;
  std::string pattern = "";
  std::size_t least = 0, most = 8;
  int lines_least = 0, lines_most = 0;
};

const std::vector<std::string> yes_no{"YES", "NO"};

const std::map<std::string, Rule>& rules() {
  using enum Place;
  const std::vector<ParameterRule> name{{"NAME", true, "l"}};
  static const std::map<std::string, Rule> table{
      {"HEADING", {model, "", {}, "t+", 0, 100, 0, any_number}},
      {"PREPRINT",
       {model,
        "",
        {{"ECHO", false, "w", yes_no},
         {"MODEL", false, "w", yes_no},
         {"HISTORY", false, "w", yes_no},
         {"CONTACT", false, "w", yes_no}}}},
      {"NODE", {model, "", {{"NSET", false, "l"}}, "irrr", 4, 4, 1, any_number}},
      {"ELEMENT",
       {model,
        "",
        {{"TYPE", true, "l", {"PC3D", "R3D4"}}, {"ELSET", false, "l"}},
        "i+",
        2,
        5,
        1,
        any_number}},
      {"ELSET", {model, "", {{"ELSET", true, "l"}, {"GENERATE"}}, "k+", 1, 16, 1, any_number}},
      {"NSET", {model, "", {{"NSET", true, "l"}, {"GENERATE"}}, "k+", 1, 16, 1, any_number}},
      {"RIGID BODY",
       {model,
        "",
        {{"REF NODE", true, "k"}, {"ELSET", true, "l"}, {"DENSITY", false, "r"}},
        "r",
        1,
        1,
        0,
        1}},
      {"SURFACE",
       {model,
        "",
        {{"NAME", true, "l"}, {"TYPE", false, "w", {"NODE", "ELEMENT"}}},
        "kw",
        1,
        2,
        1,
        any_number}},
      {"SECTION CONTROLS",
       {model,
        "",
        {{"NAME", true, "l"},
         {"KERNEL", false, "w", {"CUBIC", "QUADRATIC", "QUINTIC"}},
         {"HOURGLASS", false, "w", {"ENHANCED", "RELAX STIFFNESS", "STIFFNESS", "VISCOUS", "COMBINED"}}},
        "R+",
        0,
        8,
        0,
        3}},
      {"SOLID SECTION",
       {model,
        "",
        {{"ELSET", true, "l"}, {"MATERIAL", true, "l"}, {"CONTROLS", false, "l"}},
        "r",
        1,
        1,
        1,
        1}},
      {"MATERIAL", {model, "", name}},
      {"DENSITY", {model, "MATERIAL", {}, "r", 1, 1, 1, 1}},
      {"USER MATERIAL", {model, "MATERIAL", {{"CONSTANTS", true, "i"}}, "r+", 1, 8, 1, any_number}},
      {"DEPVAR", {model, "MATERIAL", {{"DELETE", false, "i"}}, "ilt", 1, 3, 1, any_number}},
      {"INITIAL CONDITIONS",
       {model, "", {{"TYPE", true, "w", {"STRESS", "SOLUTION", "VELOCITY"}}}, "t+", 1, 8, 1, any_number}},
      {"SURFACE INTERACTION", {model, "", name}},
      {"FRICTION", {model, "SURFACE INTERACTION", {{"ROUGH"}, {"TAUMAX", false, "r"}}, "r+", 1, 4, 0, 1}},
      {"BOUNDARY",
       {either,
        "",
        {{"TYPE", false, "w", {"DISPLACEMENT", "VELOCITY", "ACCELERATION"}},
         {"AMPLITUDE", false, "l"},
         {"OP", false, "w", {"MOD", "NEW"}}},
        "kwIR",
        2,
        4,
        1,
        any_number}},
      {"AMPLITUDE",
       {model,
        "",
        {{"NAME", true, "l"},
         {"VALUE", false, "w", {"RELATIVE", "ABSOLUTE"}},
         {"TIME", false, "w", {"STEP TIME", "TOTAL TIME"}},
         {"DEFINITION", false, "w", {"TABULAR", "SMOOTH STEP"}}},
        "r+",
        2,
        8,
        1,
        any_number}},
      {"STEP",
       {model, "", {{"NAME", false, "l"}, {"NLGEOM", false, "w", yes_no}}, "t+", 0, 100, 0, any_number}},
      {"DYNAMIC", {step, "STEP", {{"EXPLICIT", true}}, "R+", 2, 4, 1, 1}},
      {"BULK VISCOSITY", {step, "", {}, "r+", 1, 2, 1, 1}},
      {"FIXED MASS SCALING", {step, "", {{"FACTOR", false, "r"}, {"DT", false, "r"}, {"ELSET", false, "l"}}}},
      {"DLOAD",
       {step,
        "",
        {{"AMPLITUDE", false, "l"}, {"OP", false, "w", {"MOD", "NEW"}}},
        "Kwrrrr",
        3,
        6,
        1,
        any_number}},
      {"CONTACT", {either, "", {{"OP", false, "w", {"MOD", "NEW"}}}}},
      {"CONTACT INCLUSIONS", {either, "CONTACT", {{"ALL EXTERIOR"}}, "L+", 1, 2, 0, any_number}},
      {"CONTACT EXCLUSIONS", {either, "CONTACT", {}, "L+", 1, 2, 1, any_number}},
      {"CONTACT PROPERTY ASSIGNMENT", {either, "CONTACT", {}, "LLl", 3, 3, 1, any_number}},
      {"SURFACE PROPERTY ASSIGNMENT",
       {either,
        "CONTACT",
        {{"PROPERTY", true, "w", {"THICKNESS", "OFFSET FRACTION", "FEATURE EDGE CRITERIA"}}},
        "Lt+",
        2,
        3,
        1,
        any_number}},
      {"OUTPUT",
       {step,
        "",
        {{"FIELD"},
         {"HISTORY"},
         {"NUMBER INTERVAL", false, "i"},
         {"TIME INTERVAL", false, "r"},
         {"TIME MARKS", false, "w", yes_no},
         {"VARIABLE", false, "w", {"PRESELECT", "ALL"}}}}},
      {"NODE OUTPUT", {step, "OUTPUT", {{"NSET", false, "l"}}, "w+", 1, 16, 1, any_number}},
      {"ELEMENT OUTPUT", {step, "OUTPUT", {{"ELSET", false, "l"}}, "w+", 1, 16, 1, any_number}},
      {"ENERGY OUTPUT", {step, "OUTPUT", {{"ELSET", false, "l"}}, "w+", 1, 16, 1, any_number}},
      {"END STEP", {step, "", {}}},
  };
  return table;
}

/// Identifiers of output that these three keywords know.
const std::map<std::string, std::vector<std::string>> variables{
    {"NODE OUTPUT", {"U", "V", "A", "RF", "RF1", "RF2", "RF3", "RM", "UT", "VT", "COORD"}},
    {"ELEMENT OUTPUT", {"S", "SDV", "LE", "E", "PE", "PEEQ", "DENSITY", "STH", "ER", "MISES", "PRESS"}},
    {"ENERGY OUTPUT",
     {"ALLKE", "ALLIE", "ALLSE", "ALLPD", "ALLVD", "ALLFD", "ALLWK", "ALLAE", "ALLCD", "ALLPW", "ALLMW",
      "ETOTAL"}}};

bool is_word(const std::string& item) {
  auto joined = item;
  std::erase(joined, ' ');
  return is_label(joined) || as_integer(item).value_or(0) > 0;
}

/// Why an item is not of its kind; empty: it is.
std::string refusal(const std::string& item, char kind) {
  const bool optional = kind >= 'A' && kind <= 'Z';
  if (item.empty()) return optional || kind == 't' ? "" : "nothing";
  const auto found = fmt::format("'{}'", item);
  switch (optional ? char(kind - 'A' + 'a') : kind) {
  case 'i':
    return as_integer(item).value_or(0) > 0 ? "" : found + ", not a positive integer";
  case 'r':
    return as_real(item) ? "" : found + ", not a real number of at most 20 characters";
  case 'l':
    return is_label(item) ? "" : found + ", not a label";
  case 'k':
    return is_label(item) || as_integer(item).value_or(0) > 0 ? "" : found + ", not a label or number";
  case 'w':
    return is_word(item) ? "" : found + ", not a word";
  default:
    return "";
  }
}

void check_line(const Block& block, const DataLine& data, const std::string& pattern, std::size_t least,
                std::size_t most, Findings& findings) {
  if (data.items.size() < least || data.items.size() > most)
    findings.push_back({data.line, fmt::format("*{}: {} values on a line, expected {} to {}", block.keyword,
                                               data.items.size(), least, most)});
  const bool repeats = pattern.ends_with('+');
  const std::size_t kinds = pattern.size() - repeats;
  for (std::size_t i = 0; i < data.items.size() && (repeats || i < kinds); ++i)
    if (const auto why = refusal(data.items[i], pattern[std::min(i, kinds - 1)]); !why.empty())
      findings.push_back({data.line, fmt::format("*{}: value {} is {}", block.keyword, i + 1, why)});
}

void check_parameters(const Block& block, const Rule& rule, Findings& findings) {
  const auto report = [&](const std::string& text) { findings.push_back({block.line, text}); };
  for (const auto& p : block.parameters) {
    const auto known = std::ranges::find(rule.parameters, p.name, &ParameterRule::name);
    if (known == rule.parameters.end())
      report(fmt::format("*{}: unknown parameter {}", block.keyword, p.name));
    else if (known->kind.empty() != !p.value)
      report(fmt::format("*{}: parameter {} {}", block.keyword, p.name,
                         p.value ? "takes no value" : "needs a value"));
    else if (p.value && !known->words.empty() && std::ranges::count(known->words, *p.value) == 0)
      report(fmt::format("*{}: {} cannot be {}", block.keyword, p.name, *p.value));
    else if (p.value)
      if (const auto why = refusal(*p.value, known->kind[0]); !why.empty())
        report(fmt::format("*{}: {} is {}", block.keyword, p.name, why));
  }
  for (const auto& r : rule.parameters)
    if (r.required && !block.parameter(r.name))
      report(fmt::format("*{}: no parameter {}", block.keyword, r.name));
}

void check_data(const Block& block, const Rule& rule, Findings& findings) {
  const int lines = int(block.data.size());
  if (lines < rule.lines_least || lines > rule.lines_most)
    findings.push_back({lines > rule.lines_most ? block.data[rule.lines_most].line : block.line,
                        fmt::format("*{}: {} data lines, expected {} to {}", block.keyword, lines,
                                    rule.lines_least, rule.lines_most)});
  if (rule.lines_most == 0) return;
  for (const auto& data : block.data) {
    std::string pattern = rule.pattern;
    std::size_t least = rule.least, most = rule.most;
    const int index = int(&data - block.data.data());
    if (block.parameter("GENERATE")) pattern = "iii", least = 2, most = 3;
    if (block.keyword == "ELEMENT") least = most = block.value("TYPE") == "R3D4" ? 5 : 2;
    if (block.keyword == "SECTION CONTROLS" && index == 2) pattern = "r+", least = 6, most = 7;
    if (block.keyword == "DEPVAR") least = index == 0 ? 1 : 2, most = index == 0 ? 1 : 3;
    if (block.keyword == "SURFACE") pattern = block.value("TYPE") == "NODE" ? "kr" : "kw";
    if (block.keyword == "INITIAL CONDITIONS") {
      if (block.value("TYPE") == "STRESS") pattern = "kr+", least = most = 7;
      if (block.value("TYPE") == "VELOCITY") pattern = "kir", least = most = 3;
      if (block.value("TYPE") == "SOLUTION") continue; // lines of several kinds: counted with *DEPVAR
    }
    check_line(block, data, pattern, least, most, findings);
  }
  if (const auto known = variables.find(block.keyword); known != variables.end())
    for (const auto& data : block.data)
      for (const auto& item : data.items)
        if (std::ranges::count(known->second, capitals(item)) == 0)
          findings.push_back({data.line, fmt::format("*{}: unknown variable {}", block.keyword, item)});
}

/// Rules that tie several parameters or lines of one block together.
void check_block(const Block& block, Findings& findings) {
  const auto report = [&](int line, const std::string& text) {
    findings.push_back({line, fmt::format("*{}: {}", block.keyword, text)});
  };
  if (block.keyword == "FRICTION" && block.parameter("ROUGH") && !block.data.empty())
    report(block.data[0].line, "ROUGH takes no coefficient");
  if (block.keyword == "FRICTION" && !block.parameter("ROUGH") && block.data.empty())
    report(block.line, "no coefficient");
  if (block.keyword == "OUTPUT" && !block.parameter("FIELD") == !block.parameter("HISTORY"))
    report(block.line, "one of FIELD and HISTORY");
  if (block.keyword == "USER MATERIAL") {
    std::size_t count = 0;
    for (const auto& data : block.data) {
      if (&data != &block.data.back() && data.items.size() != 8)
        report(data.line, "a line of less than 8 constants");
      count += data.items.size();
    }
    if (long(count) != as_integer(block.value("CONSTANTS")).value_or(-1))
      report(block.line, fmt::format("CONSTANTS={}, but {} values", block.value("CONSTANTS"), count));
  }
  if (block.keyword == "AMPLITUDE") {
    double last = -1;
    std::size_t index = 0;
    for (const auto& data : block.data)
      for (const auto& item : data.items)
        if (index++ % 2 == 0) {
          if (const double time = as_real(item).value_or(last); time <= last)
            report(data.line, "times do not increase");
          else
            last = time;
        }
    if (index % 2) report(block.line, "a time without a value");
  }
  if (block.keyword == "DEPVAR" && block.data.size() > 1) {
    const long count = as_integer(block.data[0].items.empty() ? "" : block.data[0].items[0]).value_or(0);
    for (std::size_t i = 1; i < block.data.size(); ++i)
      if (const auto& d = block.data[i]; as_integer(d.items[0]).value_or(0) > count)
        report(d.line, fmt::format("state variable {} of {}", d.items[0], count));
  }
}

} // namespace

void check_syntax(const std::vector<Block>& blocks, Findings& findings) {
  std::string owner;
  bool in_step = false;
  for (const auto& block : blocks) {
    const auto found = rules().find(block.keyword);
    if (found == rules().end()) {
      findings.push_back({block.line, fmt::format("unknown keyword *{}", block.keyword)});
      continue;
    }
    const Rule& rule = found->second;
    if ((rule.place == Place::step) != in_step && rule.place != Place::either)
      findings.push_back(
          {block.line, fmt::format("*{} {} a step", block.keyword, in_step ? "inside of" : "outside of")});
    if (block.keyword == "BOUNDARY" && !in_step && block.value("TYPE") == "VELOCITY")
      findings.push_back({block.line, "*BOUNDARY: a velocity outside of a step"});
    if (block.keyword == "STEP") in_step = true;
    if (block.keyword == "END STEP") in_step = false;
    if (rule.under.empty())
      owner = block.keyword;
    else if (owner != rule.under)
      findings.push_back({block.line, fmt::format("*{} does not follow *{}", block.keyword, rule.under)});
    check_parameters(block, rule, findings);
    check_data(block, rule, findings);
    check_block(block, findings);
  }
  if (in_step) findings.push_back({0, "a step without *END STEP"});
}

} // namespace deck
