// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/reproducer.hpp"
#include "host/material/point_block.hpp"
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace host {
namespace {

/// A number as TOML reads it back to the same bits.
std::string number(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  const auto text = fmt::format("{}", x);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

template <class Numbers> std::string list(const Numbers& numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : ", ") + number(x);
  return "[" + text + "]";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// "(a, b, ...)" of the first `count` numbers.
std::string listed(const GuardedArray& a, std::size_t count, int digits) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format("{}{:.{}g}", text.empty() ? "" : ", ", a[i] + 0.0, digits); // no -0
  return "(" + text + ")";
}

bool all_finite(const GuardedArray& a) { // an exponent of ones: infinite or no number
  constexpr std::uint64_t ones = 0x7ff0000000000000;
  bool finite = true;
  for (const double x : a) finite &= (std::bit_cast<std::uint64_t>(x) & ones) != ones;
  return finite;
}

/// An input of point k that is not finite after a call, which as the host gave it was; empty: none.
std::string overwritten_input(const VumatBlock& b, int k) {
  std::string found;
  each_array(b, [&](const char* name, const GuardedArray& a, bool input) {
    if (!input || &a == &b.constants) return;
    for (std::size_t c = k; c < a.size(); c += b.points)
      if (!std::isfinite(a[c])) found = name;
  });
  return found;
}

/// Writes `text` to `file` and says how to use it, or that it cannot be written.
std::string write_reproducer(const std::string& text, const std::filesystem::path& file) {
  if (file.empty()) return {};
  std::error_code ignored;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  std::ofstream out(file);
  out << text;
  out.close();
  return out ? fmt::format(" (replay: simsand element {})", file.string())
             : fmt::format(" ({} cannot be written)", file.string());
}

} // namespace

PointCall point_call(const Material& material, const Increment& increment, const VumatBlock& block, int k) {
  PointCall call{increment, VumatBlock(material, 1, block.shear_components)};
  std::vector<const GuardedArray*> from;
  each_array(block, [&](const char*, const GuardedArray& a, bool) { from.push_back(&a); });
  call.block.elements[0] = block.elements[k];
  std::size_t i = 0;
  each_array(call.block, [&](const char*, GuardedArray& to, bool input) {
    const GuardedArray& a = *from[i++];
    if (input && &to != &call.block.constants)
      for (std::size_t c = 0; c < to.size(); ++c) to[c] = a[c * block.points + k];
  });
  return call;
}

int first_failure(const VumatBlock& b, int failure_state) {
  bool sound = all_finite(b.stress_new) && all_finite(b.state_new) && all_finite(b.internal_energy_new) &&
               all_finite(b.inelastic_energy_new);
  if (failure_state >= 0)
    for (int k = 0; k < b.points; ++k) sound &= !(b.state_new[failure_state * b.points + k] < 0);
  if (sound) return -1;
  for (int k = 0; k < b.points; ++k)
    if (!is_usable(b, k, failure_state)) return k;
  return -1;
}

std::string fault_of(const VumatBlock& b, int k, int failure_state) {
  if (const auto name = overwritten_input(b, k); !name.empty())
    return fmt::format("wrote a number that is not finite to {}, which is an input", name);
  const auto at = [&](const GuardedArray& a, std::size_t c) { return a[c * b.points + k]; };
  if (failure_state >= 0 && at(b.state_new, failure_state) < 0)
    return fmt::format("reported a failure, state variable {} is {:g}", failure_state + 1,
                       at(b.state_new, failure_state));
  for (int c = 0; c < 3 + b.shear_components; ++c) {
    if (has_bits(at(b.stress_new, c), unwritten_bits))
      return fmt::format("did not write component {} of stressNew", c + 1);
    if (has_bits(at(b.stress_new, c), guard_bits))
      return fmt::format(
          "returned a number that is not finite, component {} of stressNew, from words beyond an array",
          c + 1);
    if (!std::isfinite(at(b.stress_new, c)))
      return fmt::format("returned a number that is not finite, component {} of stressNew", c + 1);
  }
  for (int s = 0; s < b.state_variables; ++s)
    if (!std::isfinite(at(b.state_new, s)))
      return fmt::format("returned a number that is not finite, variable {} of stateNew", s + 1);
  if (!std::isfinite(b.internal_energy_new[k])) return "returned a number that is not finite, enerInternNew";
  if (!std::isfinite(b.inelastic_energy_new[k])) return "returned a number that is not finite, enerInelasNew";
  return {};
}

std::string reproducer_text(const Material& material, int failure_state, const PointCall& call,
                            const std::string& remark) {
  const auto& b = call.block;
  std::string text = fmt::format(
      "# {}\n# One call of the subroutine. Replay: simsand element THIS_FILE\n\n"
      "[material]\nlibrary = {}\nname = {}\nproperties = {}\nstate_variables = {}\ndensity = {}\n",
      remark, quoted(std::filesystem::absolute(material.library.path).string()), quoted(material.name),
      list(material.properties), material.state_variables, number(b.density[0]));
  if (failure_state >= 0) text += fmt::format("failure_state = {}\n", failure_state + 1);
  if (material.serial) text += "serial = true\n";
  if (material.may_write_inputs) text += "may_write_inputs = true\n";
  text +=
      fmt::format("\n# Names, components and signs of the interface: tension positive, 11, 22, 33, 12, ...\n"
                  "[call]\nelement = {}\nnshr = {}\nstepTime = {}\ntotalTime = {}\ndt = {}\n",
                  b.elements[0], b.shear_components, number(call.increment.step_time),
                  number(call.increment.total_time), number(call.increment.dt));
  each_array(b, [&](const char* name, const GuardedArray& a, bool input) {
    if (input && &a != &b.constants && a.size() > 0) text += fmt::format("{} = {}\n", name, list(a));
  });
  return text;
}

std::string evidence_of(const Material& material, int failure_state, const BadAnswer& bad,
                        const std::string& who, int dimension, const std::filesystem::path& file) {
  const auto& [increment, point] = bad.call;
  auto text = fmt::format("material {} {}: {}{}at time {:.9g} s", material.name, bad.fault, who,
                          who.empty() ? "" : " ", increment.total_time);
  if (dimension > 0) text += fmt::format(", position {} m", listed(point.coordinates, dimension, 6));
  text += fmt::format(", stress before {} Pa, strain increment {}, tension positive",
                      listed(point.stress_old, point.stress_old.size(), 9),
                      listed(point.strain_increment, point.strain_increment.size(), 6));
  return text + write_reproducer(reproducer_text(material, failure_state, bad.call, text), file);
}

} // namespace host
