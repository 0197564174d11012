// SPDX-License-Identifier: BSD-3-Clause
// Integrators that the product does not use, each as the update of one point, for comparison with its own. All
// integrate the same rate equations (rates.hpp) with the same elastic answer, gap and loss of stress (elastic.hpp);
// only the way through the plastic part of an increment differs. None falls back on another: where it does not
// converge it says so.
#pragma once
#include "tests/charts/elastic.hpp"

namespace charts {

/// Forward Euler: one step of the rates from where the increment meets the yield surface.
Answer explicit_euler(const Material& m, const Point& old, const Tensor& strain);

/// The same, then back to the yield surface at constant strain.
Answer corrected_euler(const Material& m, const Point& old, const Tensor& strain);

/// Backward Euler, closest point: flow and hardening of the end. The deviator returns along its trial, so that
/// measure of pressure and multiplier remain; they are solved for by Newton's rule with halved steps.
Answer backward_euler(const Material& m, const Point& old, const Tensor& strain);

/// Cutting plane of Simo and Ortiz (1987): the trial relaxes along the flow of each iterate.
Answer cutting_plane(const Material& m, const Point& old, const Tensor& strain);

/// Modified Euler with substeps whose error is kept below `tolerance`, and drift correction: Sloan, Abbo and Sheng
/// (2001), Engineering Computations 18:121.
Answer modified_euler(const Material& m, const Point& old, const Tensor& strain, double tolerance);

} // namespace charts
