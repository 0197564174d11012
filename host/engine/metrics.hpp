// SPDX-License-Identifier: BSD-3-Clause
// Measures of a deposit: outline, height, front, volume, and the spread of a quantity such as the void ratio.
#pragma once
#include "host/engine/particles.hpp"
#include "host/scene.hpp"
#include "host/scheme/kernel.hpp"
#include <span>

namespace host {

/// Radii (plane strain: horizontal coordinates) at which an outline is sampled, m. Without a plane of symmetry `smallest`
/// is below 0.
std::vector<double> outline_radii(double spacing, double largest, double smallest = 0);

/// Heights of the surface, m, profiles[azimuth][radius]; one profile in the plane.
using Profiles = std::vector<std::vector<double>>;

/// Height of the surface over each radius: the uppermost point where the particles fill half of the
/// kernel, sum_j V_j W = 1/2 with images across planes of symmetry and the floor at height 0, so that single grains in
/// flight do not count. In three dimensions along eight azimuths in each quarter of the circle.
template <class Geometry>
Profiles surface_profiles(const Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                          std::span<const double> radii, Sector sector = Sector::full);

/// The outline: the mean over the azimuths.
std::vector<double> mean_profile(const Profiles& profiles);

/// The mean of the surface profiles.
template <class Geometry>
std::vector<double> outline(const Particles<Geometry>& particles, const Kernel<Geometry::dimension>& kernel,
                            std::span<const double> radii, Sector sector = Sector::full);

/// Mean and standard deviation over the azimuths of the front radius, m.
struct Front {
  double mean = 0, scatter = 0;
};
Front front_of(const Profiles& profiles, std::span<const double> radii, double thickness);

/// Largest height of an outline.
double outline_height(std::span<const double> outline);

/// Outermost radius at which the outline is `thickness` high, interpolated; 0 if it is nowhere,
/// NaN if the deposit reaches past the last radius.
double front_radius(std::span<const double> radii, std::span<const double> outline, double thickness);

/// Volume under an outline, m3 (plane strain: of the half that is simulated, m2; three dimensions: of the
/// sector).
template <class Geometry>
double outline_volume(std::span<const double> radii, std::span<const double> outline,
                      Sector sector = Sector::full);

/// Smallest, mean and largest of a quantity over the particles that carry at least `least_pressure`, Pa,
/// weighted by mass; and how many those are.
struct Spread {
  double least = 0, mean = 0, most = 0;
  int particles = 0;
};
template <class Geometry>
Spread spread_of(const Particles<Geometry>& particles, std::span<const double> quantity,
                 double least_pressure);

/// Mean stress, Pa, compression positive.
template <class Geometry> double mean_pressure(const Particles<Geometry>& p, int i) {
  return -(p.stress[0][i] + p.stress[1][i] + p.stress[2][i]) / 3;
}

} // namespace host
