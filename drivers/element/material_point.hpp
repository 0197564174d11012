// SPDX-License-Identifier: BSD-3-Clause
// One material point under mixed control: the strain increment that satisfies six linear
// restrictions on stress and strain, found by Newton's method through the VUMAT interface.
#pragma once
#include "host/material/caller.hpp"

namespace drivers {

/// stress * sigma + strain * epsilon = at_start + fraction * change, for sigma and epsilon of the
/// point at a fraction 0 to 1 of the stage. Absolute, so that errors of single steps do not add up.
struct MixedControl {
  Matrix6 stress = Matrix6::Zero(), strain = Matrix6::Zero();
  Vector6 at_start = Vector6::Zero(), change = Vector6::Zero();
};

struct NewtonOptions {
  double tolerance = 1e-9;    ///< of each restriction, relative to the stress level
  int max_iterations = 20;    ///< before the increment is cut in half
  int max_cuts = 16;          ///< halvings of one increment
  double lowest_level = 1e-6; ///< smallest stress level of the tolerance, relative to the stage's
};

/// Effort and, after a failure, evidence.
struct StepReport {
  int iterations = 0, cuts = 0;
  bool converged = true;
  bool finite = true;   ///< the material returned numbers: stress, state and energies
  bool refused = false; ///< the material reported failure
  int restriction = 0;  ///< of a failure: the one least satisfied at the end asked for, from 0
  double residual = 0;  ///< what the last state reached is off by there, in its own unit
  double fraction = 0;  ///< of the stage, that could not be reached
};

/// What is large and small in a stage: stress and stiffness where it began, Pa.
struct StageScale {
  double stress, modulus;
};
StageScale scale_of(const Vector6& stress, const Matrix6& stiffness);

/// Takes `point` from one fraction of a stage to another, cutting the increment where Newton's method
/// fails. `stiffness` is the first guess and becomes that of the last iteration. After a failure
/// `point` is where the last converged part of the increment left it.
StepReport advance(MaterialCaller& material, const MixedControl& control, double from, double to,
                   double duration, const StageScale& scale, const NewtonOptions& options, PointState& point,
                   Matrix6& stiffness);

} // namespace drivers
