// SPDX-License-Identifier: BSD-3-Clause
// The simulated path of one specimen, and the curves that a laboratory would measure along it.
#pragma once
#include "calibration/lab_test.hpp"
#include <span>

namespace calibration {

/// A row for the start and for each increment. Stress in Pa, compression positive.
struct Path {
  std::vector<double> axial_strain, volumetric_strain, axial_stress, radial_stress;
  bool complete = false; ///< the end strain was reached; otherwise the material failed after the last row

  std::size_t rows() const { return axial_strain.size(); }
  void clear();
  void add(const drivers::AxisymmetricTensor& stress, const drivers::AxisymmetricTensor& strain);
  double value(Measure measure, std::size_t row, const Specimen& specimen) const;
};

/// `measure` of a path at increasing magnitudes of strain, by cubic interpolation between increments. Returns how many
/// of them the path reaches; the values of the others are not written.
std::size_t interpolate(const Path& path, const Specimen& specimen, Measure measure,
                        std::span<const double> strain, std::span<double> values);

} // namespace calibration
