// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a scene that the terms of the scheme need, beside the smoothing length, which is the kernel's.
#pragma once

namespace host {

struct Medium {
  double reference_density = 0;    ///< kg/m3, bulk density at the start
  double gravity = 0;              ///< m/s2, downwards
  double earth_pressure_ratio = 0; ///< K0: horizontal over vertical stress of the geostatic state
  double viscosity = 0;            ///< alpha of the artificial viscosity: times the wave speed
  double flow_viscosity = 0;       ///< beta: times smoothing length and velocity gradient
  double stress_diffusion = 0;     ///< in smoothing lengths squared per unit strain

  /// N/m3: what the vertical stress of the geostatic state grows by with depth.
  double unit_weight() const { return reference_density * gravity; }
};

} // namespace host
