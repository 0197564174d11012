// SPDX-License-Identifier: BSD-3-Clause
// The critical state that results are compared with: void ratio and stress ratio that a sand tends to. Its parameters
// are those of SIMSAND, or given in the path file for another material. Formulas: vumat/EQUATIONS.md (3), (6), (7).
#pragma once
#include "drivers/files/material_file.hpp"

namespace drivers {

struct CriticalState {
  double friction_angle;                   ///< degrees, triaxial compression
  double e_ref, lambda, zeta, p_at, p_min; ///< e_c = e_ref - lambda (p / p_at)^zeta; Pa

  double void_ratio(double p) const;
  /// M: q / p at a Lode angle in degrees, -30 in triaxial compression.
  double stress_ratio(double lode_angle) const;
};

/// The critical state of SIMSAND, or of the table `[critical_state]` of a path with another material; none without both.
std::optional<CriticalState> read_critical_state(const TomlTable& document, const LoadedMaterial& material);

} // namespace drivers
