// SPDX-License-Identifier: BSD-3-Clause
// The reference: the rate equations integrated by the pair of Dormand and Prince, orders 5 and 4, in steps that the
// error chooses; the change from elastic to plastic is located, and each plastic step ends on the yield surface.
// It shares functions of one state with the product, and nothing of its update.
#pragma once
#include "tests/charts/rates.hpp"

namespace charts {

struct Reference {
  Point point;
  bool found = true; ///< false: more than `most_steps`, or not finite
  long steps = 0;
};

inline constexpr double reference_tolerance = 1e-9; ///< per step: stress by p, hardening by k_p + eps_d
inline constexpr long most_steps = 200000;
/// Mean stress, as a share of p_min, below which a point counts as stress free.
inline constexpr double lost_stress = 1e-6;

/// The point after a strain that grows in proportion, from a state not outside of the yield surface.
Reference integrate_rates(const Material& m, const Point& from, const Tensor& strain,
                          double tolerance = reference_tolerance);

} // namespace charts
