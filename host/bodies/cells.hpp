// SPDX-License-Identifier: BSD-3-Clause
// The part of a body that one particle stands for.
#pragma once
#include <array>
#include <vector>

namespace host {

template <int D> struct Cell {
  std::array<double, D> center; ///< m, the last coordinate is the height
  double area;                  ///< horizontal: m2 in three dimensions, m in the plane
  double height;                ///< m
};

} // namespace host
