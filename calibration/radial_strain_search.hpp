// SPDX-License-Identifier: BSD-3-Clause
// Mixed control with one unknown: the radial strain increment of an axisymmetric specimen at which the condition held
// is met. The element driver solves six conditions at once by Newton's method (drivers/element/material_point.hpp);
// one unknown needs no stiffness matrix, and a bracket makes the search safe.
#pragma once
#include <cmath>
#include <limits>

namespace calibration {

/// Secants inside the bracket of the trials so far, for a residual that increases with the radial strain increment.
struct RadialStrainSearch {
  double trial = 0; ///< the increment to be tried
  double slope = 0; ///< d residual / d trial; 0 while unknown
  int trials = 0;   ///< answered so far

  /// Chooses the next trial from the residual of the present one. `axial_increment` scales the first steps.
  void next(double residual, double axial_increment) {
    (residual > 0 ? high : low) = trial;
    if (trials > 0 && trial != trial_before) {
      const double secant = (residual - residual_before) / (trial - trial_before);
      if (secant > 0) slope = secant;
    }
    trial_before = trial;
    residual_before = residual;
    ++trials;
    double to = slope > 0 ? trial - residual / slope : trial - std::copysign(0.1 * axial_increment, residual);
    if (!(to > low && to < high)) to = 0.5 * (low + high);
    if (!std::isfinite(to)) // no bracket yet: steps that double
      to = trial - std::copysign(std::ldexp(std::abs(axial_increment), trials - 2), residual);
    trial = to;
  }

private:
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double trial_before = 0, residual_before = 0;
};

} // namespace calibration
