// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/free_parameters.hpp"
#include "vumat/parameters.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace calibration {
namespace {

Prior read_prior(const drivers::TomlTable& table, const FreeParameter& p) {
  Prior prior;
  const auto kind = table.text("prior", {"uniform", "log-uniform", "normal", "lognormal"},
                               p.logarithmic ? "log-uniform" : "uniform");
  if (kind == "uniform") return prior;
  if (kind == "log-uniform") {
    if (!(p.lower > 0)) table.fail("prior", "bounds above 0 for log-uniform", fmt::format("{}", p.lower));
    prior.kind = Prior::Kind::log_uniform;
    return prior;
  }
  prior.kind = kind == "normal" ? Prior::Kind::normal : Prior::Kind::lognormal;
  const char* centre = kind == "normal" ? "mean" : "median";
  prior.centre = table.number(centre, {p.lower, p.upper});
  prior.deviation = table.number("deviation", {1e-12, 1e12});
  return prior;
}

FreeParameter read_parameter(const drivers::TomlTable& table, const std::string& name, int property) {
  const auto& known = simsand::parameters[property];
  FreeParameter p;
  p.name = name;
  p.property = property;
  p.lower = table.number("lower", {known.lower, known.upper});
  p.upper = table.number("upper", {known.lower, known.upper});
  if (!(p.upper > p.lower))
    table.fail("upper", fmt::format("a number above lower, {}", p.lower), fmt::format("{}", p.upper));
  const bool log_by_default = p.lower > 0 && p.upper / p.lower > 20;
  p.logarithmic = table.text("scale", {"linear", "log"}, log_by_default ? "log" : "linear") == "log";
  if (p.logarithmic && !(p.lower > 0))
    table.fail("scale", "a lower bound above 0 for log", fmt::format("{}", p.lower));
  p.prior = read_prior(table, p);
  if (table.has("start")) p.start = table.number("start", {p.lower, p.upper});
  return p;
}

} // namespace

double FreeParameter::coordinate(double v) const {
  return logarithmic ? std::log(v) : v;
}
double FreeParameter::value(double u) const {
  return logarithmic ? std::exp(u) : u;
}

double FreeParameter::log_prior(double u) const {
  if (!(u >= lowest() && u <= highest())) return -std::numeric_limits<double>::infinity();
  const double v = value(u), log_v = logarithmic ? u : std::log(std::max(v, 1e-300));
  const double jacobian = logarithmic ? u : 0; // dv/du
  switch (prior.kind) {
  case Prior::Kind::uniform:
    return jacobian;
  case Prior::Kind::log_uniform:
    return jacobian - log_v;
  case Prior::Kind::normal:
    return jacobian - 0.5 * std::pow((v - prior.centre) / prior.deviation, 2);
  case Prior::Kind::lognormal:
    return jacobian - log_v - 0.5 * std::pow((log_v - std::log(prior.centre)) / prior.deviation, 2);
  }
  return 0;
}

bool FreeParameter::has_prior_residual() const {
  return prior.kind == Prior::Kind::normal || prior.kind == Prior::Kind::lognormal;
}

double FreeParameter::prior_residual(double u) const {
  const double v = value(u);
  if (prior.kind == Prior::Kind::normal) return (v - prior.centre) / prior.deviation;
  if (prior.kind == Prior::Kind::lognormal)
    return (std::log(std::max(v, 1e-300)) - std::log(prior.centre)) / prior.deviation;
  return 0;
}

std::vector<FreeParameter> read_parameters(const drivers::TomlTable& table) {
  std::vector<FreeParameter> out;
  for (int i = 0; i < int(simsand::parameters.size()); ++i) {
    const std::string name(simsand::parameters[i].key);
    if (name == "e0" || name == "p_at") continue; // each test has its void ratio; p_at fixes a unit
    if (const auto one = table.optional_table(name)) out.push_back(read_parameter(*one, name, i));
  }
  if (out.empty()) table.fail("", "at least one table [parameter.NAME] of a free parameter", "none");
  return out;
}

} // namespace calibration
