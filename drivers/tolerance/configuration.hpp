// SPDX-License-Identifier: BSD-3-Clause
// What the accuracy and the cost of a run depend on beside its scene: words of the chart's table, settings of a scene.
#pragma once
#include "drivers/files/toml_text.hpp"
#include "host/scene.hpp"
#include <compare>
#include <string>

namespace drivers {

struct Configuration {
  std::string geometry = "axisymmetric"; ///< or "plane_strain"; three-dimensional: "quarter", "half", "full"
  std::string material = "simsand"; ///< or "drucker_prager"; "calibrated": SIMSAND by parameters of DEM tests
  std::string precision = "double"; ///< or "single": of the material's update
  double stiffness_scale = 1;       ///< of SIMSAND's K0
  double step_factor = 0.4;
  std::string kernel = "wendland-c2";
  double smoothing_length = 1.5; ///< spacings
  double resolution = 20; ///< particles in the side of a square as large as the column: sqrt(r0 h0) / spacing

  auto operator<=>(const Configuration&) const = default;
};

/// The same at another resolution.
Configuration at_resolution(Configuration configuration, double resolution);

/// sqrt(r0 h0), m.
double size_of(const host::Column& column);

/// Settings (`TABLE.KEY=VALUE`) that bring a scene of SIMSAND to the configuration. `data` is the project's data folder.
/// Drucker-Prager takes the scene's critical friction angle, no dilation, and a modulus of 2500 times the stress under
/// the column. Numerical values that are the defaults are not set.
Words settings_of(const Configuration& configuration, const host::Scene& scene, const std::string& data);

/// In words, for logs.
std::string described(const Configuration& configuration);

/// For names of folders and lines of a table.
std::string short_name(const Configuration& configuration);

} // namespace drivers
