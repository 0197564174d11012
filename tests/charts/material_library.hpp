// SPDX-License-Identifier: BSD-3-Clause
// A material library of either precision, called with points in the charts' convention.
#pragma once
#include "tests/charts/elastic.hpp"
#include "vumat/abi.hpp"
#include <span>
#include <string>

namespace charts {

template <class Real> struct LibraryBlock {
  /// With one component of shear the last two of each tensor are left out.
  explicit LibraryBlock(int points, int shear = 3);

  /// Component c of point k at [c * points + k], tension positive, as the interface has them.
  int points, shear;
  int components() const { return 3 + shear; }
  std::vector<Real> strain, stress_old, stress_new, state_old, state_new;
  std::vector<Real> density, internal_old, internal_new, inelastic_old, inelastic_new;

  void put(int k, const Point& point, const Tensor& strain_increment);
  Point get(int k) const;
  /// What `put` left of its numbers in this precision.
  void given(int k, Point& point, Tensor& strain_increment) const;
  int status(int k) const;
  void advance(); ///< makes the new values the old ones
  void call(vumat::Subroutine<Real>* subroutine, std::span<const Real> props);
};

/// `vumat_` of a library: of the one at `path`, or of the product's of this precision in the folder of the running
/// program. The library stays loaded. Throws std::runtime_error.
template <class Real> vumat::Subroutine<Real>* material_library(std::string path = "");

} // namespace charts
