// SPDX-License-Identifier: BSD-3-Clause
#include "vumat/parameters.hpp"
#include <cmath>
#include <cstdio>
#include <cstring>

namespace simsand {
namespace {

constexpr int p_at_index = parameter_index("p_at"), p_min_index = parameter_index("p_min");
// A fallback in units of p_at needs p_at before it.
static_assert(0 <= p_at_index && p_at_index < p_min_index);

/// Pressures above this share of p_at are no longer a numerical floor but a cohesion.
constexpr double largest_floor_per_p_at = 0.1;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string code(std::string_view text) {
  return std::string("`").append(text).append("`");
}

/// One line of a Markdown table.
std::string row(std::initializer_list<std::string_view> cells) {
  std::string out = "|";
  for (const std::string_view cell : cells) out.append(" ").append(cell).append(" |");
  return out.append("\n");
}

} // namespace

template <class Real> PropsError read_props(const Real* props, int count, Parameters<Real>& out) noexcept {
  std::array<Real, parameters.size()> value{};
  for (int i = 0; i < int(parameters.size()); ++i) {
    const ParameterInfo& info = parameters[i];
    const bool has_fallback = !std::isnan(info.fallback_per_p_at);
    if (i >= count && !has_fallback) return {i + 1, "missing"};
    value[i] = i < count ? props[i] : Real(0);
    if (value[i] == 0 && has_fallback) value[i] = Real(info.fallback_per_p_at) * value[p_at_index];
    if (!std::isfinite(value[i])) return {i + 1, "not finite"};
    if (value[i] < Real(info.lower)) return {i + 1, "below its lower bound"};
    if (value[i] > Real(info.upper)) return {i + 1, "above its upper bound"};
  }
  if (value[p_min_index] > Real(largest_floor_per_p_at) * value[p_at_index])
    return {p_min_index + 1, "above 0.1 p_at"};
  std::memcpy(&out, value.data(), sizeof out); // the members stand in the order of the table
  return {};
}

template PropsError read_props(const float*, int, Parameters<float>&) noexcept;
template PropsError read_props(const double*, int, Parameters<double>&) noexcept;

std::string parameter_table() {
  std::string out =
      "| PROPS | key | symbol | unit | from | to | default | meaning |\n|---|---|---|---|---|---|---|---|\n";
  for (int i = 0; i < int(parameters.size()); ++i) {
    const ParameterInfo& p = parameters[i];
    const bool given = std::isnan(p.fallback_per_p_at);
    out += row({number(i + 1), code(p.key), p.symbol, p.unit, number(p.lower), number(p.upper),
                given ? "" : number(p.fallback_per_p_at) + " p_at", p.meaning});
  }
  return out;
}

std::string state_table() {
  std::string out = "| STATEV | name | unit | meaning |\n|---|---|---|---|\n";
  for (int i = 0; i < int(state_variables.size()); ++i)
    out += row(
        {number(i + 1), code(state_variables[i].name), state_variables[i].unit, state_variables[i].meaning});
  return out;
}

} // namespace simsand
