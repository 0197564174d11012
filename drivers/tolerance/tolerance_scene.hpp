// SPDX-License-Identifier: BSD-3-Clause
// A scene that leaves to the chart what the chart chooses.
#pragma once
#include "drivers/tolerance/chart_data.hpp"

namespace drivers {

/// Reads the scene and refuses what conflicts with a choice: settings of keys that are chosen, another material than
/// SIMSAND or another library of it, a stiffness scale, numbers of the scheme that are not the defaults (the chart holds for
/// these). Throws std::runtime_error naming file, line and key, or the setting.
host::Scene read_scene_to_choose(const std::string& file, const Words& settings);

/// What a scene has that no column of the chart had: remarks, empty if there is nothing.
Words beyond_the_chart(const host::Scene& scene);

/// Resolution that the scene needs where the chart's columns need `resolution`: grains that are smaller against the
/// column than any of the chart's (0.042 sqrt(r0 h0)) need as many particles in their diameter, for the front is where the
/// deposit is one of them high.
double scene_resolution(const host::Scene& scene, double resolution);

/// The resolved scene as TOML without what the settings of a configuration say anew.
std::string scene_without_choice(const host::Scene& scene, const Configuration& configuration);

} // namespace drivers
