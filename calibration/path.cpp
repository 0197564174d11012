// SPDX-License-Identifier: BSD-3-Clause
// Measured quantities at the rows of a simulated path, and between them.
#include "calibration/path.hpp"
#include <cmath>

namespace calibration {

void Path::clear() {
  for (auto* column : {&axial_strain, &volumetric_strain, &axial_stress, &radial_stress}) column->clear();
  complete = false;
}

void Path::add(const drivers::AxisymmetricTensor& stress, const drivers::AxisymmetricTensor& strain) {
  axial_strain.push_back(strain.axial);
  volumetric_strain.push_back(strain.trace());
  axial_stress.push_back(stress.axial);
  radial_stress.push_back(stress.radial);
}

double Path::value(Measure measure, std::size_t row, const Specimen& specimen) const {
  const double axial = axial_stress[row], radial = radial_stress[row];
  const double p = (axial + 2 * radial) / 3, q = axial - radial;
  switch (measure) {
  case Measure::deviatoric_stress:
    return q;
  case Measure::axial_stress:
    return axial;
  case Measure::radial_stress:
    return radial;
  case Measure::mean_stress:
    return p;
  case Measure::stress_ratio:
    return p > 0 ? q / p : 0;
  case Measure::volumetric_strain:
    return volumetric_strain[row];
  case Measure::void_ratio:
    return (1 + specimen.void_ratio) * std::exp(-volumetric_strain[row]) - 1;
  case Measure::pore_pressure:
    return specimen.radial_stress - radial; // as the total radial stress, the cell pressure, is constant
  }
  return 0;
}

std::size_t interpolate(const Path& path, const Specimen& specimen, Measure measure,
                        std::span<const double> strain, std::span<double> values) {
  const auto& at = path.axial_strain;
  const std::size_t rows = at.size();
  std::size_t row = 0; // the increment from row to row + 1 holds the strain
  double y[4] = {}, slope[2] = {};
  std::size_t prepared = rows;
  const auto value = [&](std::size_t r) { return path.value(measure, r, specimen); };
  // Slope, at the middle one of three rows, of the parabola through them.
  const auto middle_slope = [&](std::size_t r) {
    const double a = at[r] - at[r - 1], b = at[r + 1] - at[r];
    return ((value(r + 1) - value(r)) * a / b + (value(r) - value(r - 1)) * b / a) / (a + b);
  };
  for (std::size_t i = 0; i < strain.size(); ++i) {
    while (row + 1 < rows && std::abs(at[row + 1]) < std::abs(strain[i])) ++row;
    if (row + 1 >= rows) {
      if (rows > 0 && strain[i] == at[0]) { // the path ends at its start
        values[i] = value(0);
        continue;
      }
      return i;
    }
    const double h = at[row + 1] - at[row];
    if (prepared != row) {
      y[0] = value(row);
      y[1] = value(row + 1);
      const double straight = (y[1] - y[0]) / h;
      slope[0] = row > 0 ? middle_slope(row) : straight;
      slope[1] = row + 2 < rows ? middle_slope(row + 1) : straight;
      prepared = row;
    }
    const double t = (strain[i] - at[row]) / h;
    const double bend = h * ((1 - t) * (slope[0] - (y[1] - y[0]) / h) - t * (slope[1] - (y[1] - y[0]) / h));
    values[i] = y[0] + t * (y[1] - y[0]) + t * (1 - t) * bend;
  }
  return strain.size();
}

} // namespace calibration
