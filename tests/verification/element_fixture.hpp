// SPDX-License-Identifier: BSD-3-Clause
// Element tests from text: materials, runs, and what is read from their rows.
#pragma once
#include "drivers/element/element.hpp"
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>

namespace element_fixture {

using namespace drivers;

inline const std::string paths = SIMSAND_SOURCE_DIR "/data/paths";

struct Shape {
  std::string name;
  double phi, e_ref; // degrees, -
};
inline const Shape shapes[] = {{"SS", 18.5, 0.76}, {"TS", 24, 0.76}, {"ES", 26, 0.74}};
constexpr double p_at = 101325, lambda = 0.04, zeta = 0.3; // of all three

/// q/p at the critical state, in triaxial compression (sign 1) or extension (-1), equations (6), (7).
inline double critical_ratio(const Shape& s, double sign) {
  const double sine = std::sin(s.phi * M_PI / 180);
  return 6 * sine / (3 - sign * sine);
}

inline double critical_void_ratio(const Shape& s, double p) {
  return s.e_ref - lambda * std::pow(p / p_at, zeta);
}

inline std::string path_text(const std::string& shape, double e0, double p, const std::string& stages) {
  return fmt::format(
      "[material]\nfile = '../materials/{}.toml'\n[initial]\nvoid_ratio = {}\nmean_stress = {}\n{}", shape,
      e0, toml_number(p), stages);
}

inline ElementCase case_of(const std::string& text) {
  return read_element_case(parse_toml(text, "path.toml", paths));
}

inline std::string stage_text(const std::string& control, const std::string& rest) {
  return fmt::format("[[stage]]\nname = 'shear'\ncontrol = '{}'\n{}\n", control, rest);
}

inline std::vector<ElementRow> rows_of(const std::string& text) {
  std::vector<ElementRow> rows;
  run_element_case(case_of(text), [&](const ElementRow& r) { rows.push_back(r); });
  return rows;
}

inline double void_ratio(double e0, const ElementRow& r) {
  return (1 + e0) * std::exp(-volumetric_strain(r.point.strain)) - 1;
}
inline double p_of(const ElementRow& r) {
  return mean_stress(r.point.stress);
}
/// sqrt(2/3 e:e).
inline double strain_deviator(const ElementRow& r) {
  return deviatoric_strain(r.point.strain);
}
inline double q_of(const ElementRow& r) {
  return deviatoric_stress(r.point.stress);
}

inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

} // namespace element_fixture
