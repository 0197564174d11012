// SPDX-License-Identifier: BSD-3-Clause
// Noise of the mean stress on the scale of the particles: what a checkerboard of pressures has and a smooth field has not.
#pragma once
#include "host/engine/metrics.hpp"
#include "host/scheme/kernel.hpp"
#include <Eigen/Dense>

namespace charts {

/// Checkerboard index: sqrt(sum V (p - p*)^2 / sum V p^2) over the particles whose mean stress p, compression positive,
/// is at least `least_pressure`, Pa; p* is the value at the particle of the plane fitted to the p of its neighbours
/// within the support (itself left out; squares weighted by V W). 0 for any linear field, 1 + 1/s for pressures of
/// +-p on alternate particles, s the number of effective neighbours; particles with fewer than six neighbours are
/// left out. 0 if there is none.
template <class Geometry>
double checkerboard_index(const host::Particles<Geometry>& p, const host::Kernel<Geometry::dimension>& kernel,
                          double least_pressure) {
  constexpr int D = Geometry::dimension, few = 6;
  using Vector = Eigen::Matrix<double, D + 1, 1>;
  using Matrix = Eigen::Matrix<double, D + 1, D + 1>;
  double noise = 0, all = 0;
  for (int i = 0; i < p.count; ++i) {
    const double pressure = host::mean_pressure(p, i);
    if (!(pressure >= least_pressure)) continue;
    Matrix squares = Matrix::Zero();
    Vector products = Vector::Zero();
    int neighbours = 0;
    for (int j = 0; j < p.count; ++j) {
      Vector x;
      double r2 = 0;
      x[0] = 1;
      for (int a = 0; a < D; ++a) {
        x[a + 1] = (p.position[a][j] - p.position[a][i]) / kernel.h;
        r2 += x[a + 1] * x[a + 1];
      }
      if (j == i || r2 >= 4) continue;
      const double weight = p.mass[j] / p.density[j] * kernel.value(std::sqrt(r2) * kernel.h);
      squares += weight * x * x.transpose();
      products += weight * host::mean_pressure(p, j) * x;
      ++neighbours;
    }
    if (neighbours < few) continue;
    const double fitted = squares.ldlt().solve(products)[0], volume = p.mass[i] / p.density[i];
    if (!std::isfinite(fitted)) continue; // neighbours on a line
    noise += volume * (pressure - fitted) * (pressure - fitted);
    all += volume * pressure * pressure;
  }
  return all > 0 ? std::sqrt(noise / all) : 0;
}

} // namespace charts
