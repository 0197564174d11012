// SPDX-License-Identifier: BSD-3-Clause
#include "host/reproducer.hpp"
#include "host/vumat_utilities.hpp"
#include <cmath>
#include <filesystem>
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

} // namespace

PointCall point_call(const Material& material, const Increment& increment, const VumatBlock& block, int k) {
  PointCall call{increment, VumatBlock(material, 1, block.shear_components)};
  std::vector<const GuardedArray*> from;
  each_array(block, [&](const char*, const GuardedArray& a, bool) { from.push_back(&a); });
  std::size_t i = 0;
  each_array(call.block, [&](const char*, GuardedArray& to, bool input) {
    const GuardedArray& a = *from[i++];
    if (input && &to != &call.block.constants)
      for (std::size_t c = 0; c < to.size(); ++c) to[c] = a[c * block.points + k];
  });
  return call;
}

std::string fault_of(const VumatBlock& b, int k, int failure_state) {
  const auto at = [&](const GuardedArray& a, std::size_t c) { return a[c * b.points + k]; };
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
  if (failure_state >= 0 && at(b.state_new, failure_state) < 0)
    return fmt::format("reported a failure, state variable {} is {:g}", failure_state + 1,
                       at(b.state_new, failure_state));
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
  text +=
      fmt::format("\n# Names, components and signs of the interface: tension positive, 11, 22, 33, 12, ...\n"
                  "[call]\nnshr = {}\nstepTime = {}\ntotalTime = {}\ndt = {}\n",
                  b.shear_components, number(call.increment.step_time), number(call.increment.total_time),
                  number(call.increment.dt));
  each_array(b, [&](const char* name, const GuardedArray& a, bool input) {
    if (input && &a != &b.constants && a.size() > 0) text += fmt::format("{} = {}\n", name, list(a));
  });
  return text;
}

std::string write_reproducer(const std::string& text) {
  if (job().folder.empty()) return {};
  const auto file = std::filesystem::path(job().folder) / "failed_point.toml";
  std::error_code ignored;
  std::filesystem::create_directories(job().folder, ignored);
  std::ofstream out(file);
  out << text;
  out.close();
  return out ? fmt::format(" (replay: simsand element {})", file.string())
             : fmt::format(" ({} cannot be written)", file.string());
}

} // namespace host
