// SPDX-License-Identifier: BSD-3-Clause
// Inputs of VUMAT calls, point by point.
#pragma once
#include <vector>

namespace benchmark {

/// Tension positive, Pa; components in the order of the VUMAT.
struct PointInput {
  std::vector<double> stress, strain, state;
  double density; ///< kg/m3
};

struct States {
  std::vector<double> properties; ///< PROPS
  int shear_components = 1;       ///< nshr
  std::vector<PointInput> updates;
};

} // namespace benchmark
