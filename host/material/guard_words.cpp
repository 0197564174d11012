// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/guard_words.hpp"
#include "host/material/block.hpp"
#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

namespace host {
namespace {

[[noreturn]] void refuse(const Material& material, const std::string& what) {
  throw std::runtime_error(fmt::format("material {}: {}", material.name, what));
}

/// Calls `f(name, words)` for the arguments that are integers or text.
template <class F> void each_of_words(const VumatBlock& block, F&& f) {
  f("jInfoArray", block.info);
  f("cmname", block.passed_name);
}

} // namespace

void check_guards(const Material& material, const VumatBlock& block, bool far) {
  bool intact = true;
  each_array(block, [&](const char*, const GuardedArray& a, bool) {
    intact &= a.intact_before();
    intact &= a.intact_after();
    if (far) intact &= a.intact_far_after();
  });
  each_of_words(block, [&](const char*, const auto& a) { intact &= a.intact_before() & a.intact_after(); });
  const auto& constants = material.properties;
  intact &= constants.empty() ||
            std::memcmp(block.constants.data(), constants.data(), constants.size() * sizeof(double)) == 0;
  if (intact) return;
  const auto refuse_unless = [&](const char* name, bool after, bool before) {
    if (!after) refuse(material, fmt::format("its subroutine wrote beyond the end of {}", name));
    if (!before) refuse(material, fmt::format("its subroutine wrote before the start of {}", name));
  };
  each_array(block, [&](const char* name, const GuardedArray& a, bool) {
    refuse_unless(name, a.intact_far_after(), a.intact_before());
  });
  each_of_words(block, [&](const char* name, const auto& a) {
    refuse_unless(name, a.intact_after(), a.intact_before());
  });
  refuse(material, "its subroutine wrote to props, which is an input (may_write_inputs = true lets it)");
}

void copy_inputs(VumatBlock& block) {
  block.input_copy.clear(); // keeps its memory
  each_array(block, [&](const char*, const GuardedArray& a, bool input) {
    if (input) block.input_copy.insert(block.input_copy.end(), a.begin(), a.end());
  });
}

void check_inputs(const Material& material, const VumatBlock& block) {
  const double* at = block.input_copy.data();
  each_array(block, [&](const char* name, const GuardedArray& a, bool input) {
    if (!input) return;
    if (a.size() > 0 && std::memcmp(a.data(), at, a.size() * sizeof(double)) != 0)
      refuse(material, fmt::format("its subroutine wrote to {}, which is an input "
                                   "(may_write_inputs = true lets it)",
                                   name));
    at += a.size();
  });
}

void restore_inputs(VumatBlock& block) {
  const double* at = block.input_copy.data();
  each_array(block, [&](const char*, GuardedArray& a, bool input) {
    if (!input) return;
    std::copy_n(at, a.size(), a.begin());
    at += a.size();
  });
}

} // namespace host
