// SPDX-License-Identifier: BSD-3-Clause
// `simsand run --plan`: what a run will take, from its lattice and a short burst of its own steps.
#pragma once
#include "host/scene.hpp"
#include <string>

namespace drivers {

struct Plan {
  int particles = 0;
  double end = 0;              ///< s, simulated, expected
  double latest_end = 0;       ///< s, simulated
  double step = 0;             ///< s, mean
  double steps = 0;            ///< expected
  double seconds_per_step = 0; ///< of wall clock, with the threads of this call on free cores
  double memory = 0;           ///< bytes at most in use
  double disk = 0;             ///< bytes of the result; while it runs, as much again and `checkpoint`
  double checkpoint = 0;       ///< bytes of both checkpoints

  double seconds() const { return steps * seconds_per_step; }
  double most_seconds() const { return seconds() * latest_end / end; }
};

/// Sets the scene up and runs its first steps for `burst` s, without writing anything.
Plan plan_run(const host::Scene& scene, double burst = 0.3);

/// The plan as a page.
std::string described(const Plan& plan, const host::Scene& scene);

} // namespace drivers
