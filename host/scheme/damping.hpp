// SPDX-License-Identifier: BSD-3-Clause
// How strongly noise is damped: the speed of the artificial viscosity and the diffusivity of stress.
#pragma once
#include "host/scheme/lane.hpp"
#include "host/scheme/medium.hpp"

namespace host {

/// Speed of the artificial viscosity, m/s: alpha c + beta h |grad v|, at most c / 2. The second term damps noise as
/// strain makes it. The first acts in a deposit at rest as well. It must be small: with it, motions of the pair sums that
/// no strain resists hold slopes up, which creep down later.
template <class Real>
Real damping_speed(const Medium& medium, double h, const Real& wave_speed, const Real& gradient_norm) {
  return smaller(0.5 * wave_speed, medium.viscosity * wave_speed + medium.flow_viscosity * h * gradient_norm);
}

/// Diffusivity of stress, m2/s: delta h2 |grad v|, so that noise is smoothed as strain makes it and a deposit at rest
/// keeps its stress; at most 0.1 h c, above which it would limit the step.
template <class Real>
Real stress_diffusivity(const Medium& medium, double h, const Real& wave_speed, const Real& gradient_norm) {
  return smaller(medium.stress_diffusion * h * h * gradient_norm, 0.1 * h * wave_speed);
}

} // namespace host
