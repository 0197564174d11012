// SPDX-License-Identifier: BSD-3-Clause
#include "tests/abaqus/deck_model.hpp"
#include <fmt/format.h>

namespace deck {
namespace {

Members members_of(const std::map<std::string, Members>& sets, const std::string& name) {
  if (const auto number = as_integer(name)) return {*number};
  const auto found = sets.find(capitals(name));
  return found == sets.end() ? Members{} : found->second;
}

/// Fills the model block by block and reports what is used before it is there.
struct Builder {
  Model model;
  Findings& findings;

  void report(int line, const std::string& text) { findings.push_back({line, text}); }

  void define(const std::string& what, const std::string& name, int line) {
    if (!model.names[what].insert(capitals(name)).second)
      report(line, fmt::format("{} {} defined twice", what, name));
  }
  void need(const std::string& what, const std::string& name, int line) {
    if (!name.empty() && !model.names[what].contains(capitals(name)))
      report(line, fmt::format("{} {} is not defined above", what, name));
  }
  void need_nodes(const std::string& name, int line) {
    if (const auto number = as_integer(name)) {
      if (!model.nodes.contains(*number)) report(line, fmt::format("node {} is not defined above", name));
    } else if (!model.node_sets.contains(capitals(name)))
      report(line, fmt::format("node set {} is not defined above", name));
  }
  void need_elements(const std::string& name, int line) {
    if (const auto number = as_integer(name)) {
      if (!model.elements.contains(*number))
        report(line, fmt::format("element {} is not defined above", name));
    } else if (!model.element_sets.contains(capitals(name)))
      report(line, fmt::format("element set {} is not defined above", name));
  }

  void nodes(const Block& block) {
    for (const auto& d : block.data) {
      if (d.items.size() != 4 || !as_integer(d.items[0])) continue; // reported by the rules
      const long id = *as_integer(d.items[0]);
      Point p{};
      for (int c = 0; c < 3; ++c) p[c] = as_real(d.items[c + 1]).value_or(0);
      if (!model.nodes.emplace(id, p).second) report(d.line, fmt::format("node {} defined twice", id));
      if (const auto set = block.value("NSET"); !set.empty()) model.node_sets[set].push_back(id);
    }
  }

  void elements(const Block& block) {
    for (const auto& d : block.data) {
      if (d.items.empty() || !as_integer(d.items[0])) continue;
      const long id = *as_integer(d.items[0]);
      Element element{block.value("TYPE"), {}, d.line};
      for (std::size_t i = 1; i < d.items.size(); ++i) {
        need_nodes(d.items[i], d.line);
        element.nodes.push_back(as_integer(d.items[i]).value_or(0));
      }
      if (std::set(element.nodes.begin(), element.nodes.end()).size() != element.nodes.size())
        report(d.line, fmt::format("element {} uses a node twice", id));
      if (!model.elements.emplace(id, element).second)
        report(d.line, fmt::format("element {} defined twice", id));
      if (const auto set = block.value("ELSET"); !set.empty()) model.element_sets[set].push_back(id);
    }
  }

  void set(const Block& block, std::map<std::string, Members>& sets, bool of_elements) {
    auto& members = sets[block.value(block.keyword)];
    for (const auto& d : block.data) {
      std::vector<std::string> items = d.items;
      if (block.parameter("GENERATE") && items.size() >= 2) {
        const long first = as_integer(items[0]).value_or(1), last = as_integer(items[1]).value_or(0);
        const long stride = items.size() > 2 ? as_integer(items[2]).value_or(1) : 1;
        items.clear();
        if (last < first || stride < 1 || last - first > 100'000'000)
          report(d.line, "a range without members");
        else
          for (long i = first; i <= last; i += stride) items.push_back(std::to_string(i));
      }
      for (const auto& item : items) {
        of_elements ? need_elements(item, d.line) : need_nodes(item, d.line);
        const auto added = members_of(sets, item);
        members.insert(members.end(), added.begin(), added.end());
      }
    }
  }

  void rigid_body(const Block& block) {
    need_elements(block.value("ELSET"), block.line);
    need_nodes(block.value("REF NODE"), block.line);
  }

  void surface(const Block& block) {
    define("surface", block.value("NAME"), block.line);
    for (const auto& d : block.data)
      if (!d.items.empty())
        block.value("TYPE") == "NODE" ? need_nodes(d.items[0], d.line) : need_elements(d.items[0], d.line);
  }

  void first_items(const Block& block, bool of_elements) {
    for (const auto& d : block.data)
      if (!d.items.empty()) of_elements ? need_elements(d.items[0], d.line) : need_nodes(d.items[0], d.line);
  }

  void contact(const Block& block) {
    const bool assigns = block.keyword == "CONTACT PROPERTY ASSIGNMENT";
    const std::size_t surfaces = block.keyword == "SURFACE PROPERTY ASSIGNMENT" ? 1 : 2;
    for (const auto& d : block.data) {
      for (std::size_t i = 0; i < std::min(surfaces, d.items.size()); ++i)
        need("surface", d.items[i], d.line);
      if (assigns && d.items.size() > 2) need("surface interaction", d.items[2], d.line);
    }
  }

  void add(const Block& block) {
    const auto& k = block.keyword;
    if (k == "NODE") nodes(block);
    if (k == "ELEMENT") elements(block);
    if (k == "NSET") set(block, model.node_sets, false);
    if (k == "ELSET") set(block, model.element_sets, true);
    if (k == "RIGID BODY") rigid_body(block);
    if (k == "SURFACE") surface(block);
    if (k == "SECTION CONTROLS") define("section controls", block.value("NAME"), block.line);
    if (k == "MATERIAL") define("material", block.value("NAME"), block.line);
    if (k == "SURFACE INTERACTION") define("surface interaction", block.value("NAME"), block.line);
    if (k == "AMPLITUDE") define("amplitude", block.value("NAME"), block.line);
    if (k == "SOLID SECTION") {
      need_elements(block.value("ELSET"), block.line);
      need("material", block.value("MATERIAL"), block.line);
      need("section controls", block.value("CONTROLS"), block.line);
    }
    if (k == "INITIAL CONDITIONS" && block.value("TYPE") == "STRESS") first_items(block, true);
    if (k == "BOUNDARY") first_items(block, false);
    if (k == "DLOAD") first_items(block, true);
    if (k == "BOUNDARY" || k == "DLOAD") need("amplitude", block.value("AMPLITUDE"), block.line);
    if (k.starts_with("CONTACT ") || k == "SURFACE PROPERTY ASSIGNMENT") contact(block);
    if (k == "NODE OUTPUT" && block.parameter("NSET")) need_nodes(block.value("NSET"), block.line);
    if (k == "ELEMENT OUTPUT" && block.parameter("ELSET")) need_elements(block.value("ELSET"), block.line);
  }
};

} // namespace

Members Model::elements_of(const std::string& name) const {
  return members_of(element_sets, name);
}
Members Model::nodes_of(const std::string& name) const {
  return members_of(node_sets, name);
}

Model build_model(const std::vector<Block>& blocks, Findings& findings) {
  Builder builder{{}, findings};
  for (const auto& block : blocks) builder.add(block);
  return std::move(builder.model);
}

} // namespace deck
