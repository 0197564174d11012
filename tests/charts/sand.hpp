// SPDX-License-Identifier: BSD-3-Clause
// What the charts share: the three sands, and names of the model's types for one point in double precision.
// Compression positive; stress in Pa; components 11, 22, 33, 12, 23, 31, shear as tensor components.
#pragma once
#include "vumat/simsand.hpp"
#include <array>
#include <string_view>
#include <vector>

namespace charts {

using Tensor = simsand::SymmetricTensor<double, 6>;
using Point = simsand::SoilState<double, 6>;
using Material = simsand::Material<double>;

/// A sand of data/materials: its friction angle (degrees), critical void ratio at zero pressure, and the void ratios
/// of its dense and loose packings.
struct Sand {
  std::string_view name;
  double phi, e_ref, dense, loose;
};
inline constexpr std::array<Sand, 3> sands{
    {{"SS", 18.5, 0.76, 0.58, 0.70}, {"TS", 24, 0.76, 0.44, 0.72}, {"ES", 26, 0.74, 0.448, 0.70}}};

/// PROPS of a sand; p_min is 1 Pa.
inline std::vector<double> properties(const Sand& sand) {
  return {100, 0.2, 0.51, sand.phi, sand.e_ref, 0.04, 0.3, 1, 0.0015, 3.3, 1, sand.dense, 101325, 1};
}

inline Material material_of(const std::vector<double>& props) {
  simsand::Parameters<double> parameters{};
  simsand::read_props(props.data(), int(props.size()), parameters);
  return Material(parameters);
}

inline double mean(const Tensor& stress) {
  return simsand::trace(stress) / 3;
}

/// sqrt(a : a)
inline double norm(const Tensor& a) {
  return std::sqrt(simsand::contract(a, a));
}

/// The deviator along `a` with q = 1, that is s:s = 2/3; 0 where `a` has none.
inline Tensor unit_deviator(const Tensor& a) {
  const auto s = simsand::deviator(a);
  const double q = simsand::deviatoric_stress(s);
  return q > 0 ? simsand::scale(1 / q, s) : s;
}

} // namespace charts
