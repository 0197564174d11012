// SPDX-License-Identifier: BSD-3-Clause
// What every integrator of the chart does alike: strain before the grains touch, the elastic answer, where it meets
// the yield surface, and the end of a point that has parted.
#pragma once
#include "tests/charts/rates.hpp"

namespace charts {

/// What an update gave. `converged` is what the integrator itself knows of its success.
struct Answer {
  Point point;
  bool converged = true;
};

/// Elastic answer: pressure by its exact integral (12), (14), shear by the mean of G at both ends (13).
/// The stress is zero where the pressure would not be positive.
struct Elastic {
  Point point;
  double measure;    ///< y at the end, not bounded
  double stiffening; ///< dy per elastic volumetric strain
};
Elastic elastic_answer(const Material& m, const Point& old, const Tensor& strain);

/// Share of the strain that passes inside the yield surface: 0 if it loads plastically from the start, 1 if the
/// whole increment is elastic. By the regula falsi (Pegasus) of Sloan, Abbo and Sheng (2001).
double elastic_share(const Material& m, const Point& old, const Tensor& strain);

/// A point without stress; the gap is the volumetric extension less what emptied the point.
Point parted(const Material& m, const Point& old, double volumetric, double plastic_volumetric,
             double multiplier);

/// Removes a distance from the yield surface by plastic flow at constant strain (Potts and Gens 1985); false: still
/// more than 1e-9 p after ten steps.
bool correct_drift(const Material& m, Point& point, const Tensor& strain);

/// Lets a gap take its share of the strain, and gives the rest to `update(point, strain)`.
template <class Update> Answer after_gap(const Point& old, const Tensor& strain, const Update& update) {
  if (!(old.separation_strain > 0)) return update(old, strain);
  const double volumetric = simsand::trace(strain), left = volumetric - old.separation_strain;
  if (left <= 0)
    return {{{}, simsand::void_ratio_after(old.void_ratio, volumetric), old.plastic_strain, -left}};
  const Point closed{
      {}, simsand::void_ratio_after(old.void_ratio, old.separation_strain), old.plastic_strain, 0};
  return update(closed, simsand::scale(left / volumetric, strain));
}

} // namespace charts
