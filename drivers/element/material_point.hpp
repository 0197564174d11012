// SPDX-License-Identifier: BSD-3-Clause
// One material point under mixed control: the strain increment that meets six linear conditions on stress and
// strain, found by Newton's method through the VUMAT interface.
#pragma once
#include "host/material/caller.hpp"

namespace drivers {

/// stress * sigma + strain * epsilon = at_start + fraction * change, for the stress sigma (Pa, compression positive) and
/// strain epsilon at a fraction 0 to 1 of the stage. Total values, so that errors of single increments do not add up.
struct MixedControl {
  Matrix6 stress = Matrix6::Zero(), strain = Matrix6::Zero();
  Vector6 at_start = Vector6::Zero(), change = Vector6::Zero();
};

struct NewtonOptions {
  double tolerance = 1e-9; ///< of each condition, relative to the stress level
  int max_iterations = 20; ///< before the increment is cut in half
  int max_cuts = 16;       ///< halvings of one increment
  double lowest_level =
      1e-6; ///< smallest stress level that the tolerance refers to, relative to StageScale::stress
};

/// What an increment took, and how it failed if it did.
struct StepReport {
  int iterations = 0, cuts = 0;
  bool converged = true;
  bool finite = true;   ///< the material returned numbers: stress, state and energies
  bool refused = false; ///< the material reported failure
  int condition = 0;    ///< after a failure: the one with the largest residual over its tolerance, from 0
  double residual = 0;  ///< of that condition, in its own unit
  double fraction = 0;  ///< of the stage, that could not be reached
};

/// Stress level and largest stiffness at the start of a stage, Pa: the scales of its tolerances.
struct StageScale {
  double stress, modulus;
};
StageScale scale_of(const Vector6& stress, const Matrix6& stiffness);

/// Takes `point` from one fraction of a stage to another and cuts the increment where Newton's method fails. `duration`
/// of the stage in s. `stiffness` is the first guess and becomes that of the last iteration. After a failure `point`
/// is where the last converged part of the increment left it.
StepReport advance(MaterialCaller& material, const MixedControl& control, double from, double to,
                   double duration, const StageScale& scale, const NewtonOptions& options, PointState& point,
                   Matrix6& stiffness);

} // namespace drivers
