// SPDX-License-Identifier: BSD-3-Clause
// Materials from TOML. A `[material]` table holds either `file = "TS.toml"` (and any key that is to
// differ from it) or the keys themselves. Units are SI: stress in Pa, density in kg/m3.
//
// SIMSAND: the keys of simsand::parameters, `grain_density`, and optionally `name`, `library`, `void_ratio`.
// Another library: `library`, `name`, `properties = [...]`, `state_variables = n`, and optionally
// `state_names = [...]`, `initial_state = [...]`, `failure_state` (number, from 1, of the state variable
// that is negative after a failed update), and `density` or `grain_density`.
// Any: `kinematics` ("green-naghdi" or "jaumann"), `serial`, `may_write_inputs` (host/material/VUMAT_HOST.md).
#pragma once
#include "drivers/files/toml_table.hpp"
#include "host/material/block.hpp"
#include <optional>
#include <string>
#include <vector>

namespace drivers {

struct LoadedMaterial {
  host::Material material;
  std::vector<std::string> state_names; ///< one per state variable
  std::vector<double> initial_state;    ///< STATEV before the first increment
  int failure_state = -1;               ///< position in STATEV, from 0; -1: there is none
  std::optional<double> void_ratio;     ///< initial
  bool is_simsand = false;              ///< PROPS are those of simsand::parameters
  double bulk_density = 0;              ///< kg/m3, initial
};

/// Reads a `[material]` table and loads its library. `void_ratio` is the initial one, from the scene or
/// path; without it the table or its file must give `void_ratio`. Calls finish() on the file it opens,
/// not on `table`.
LoadedMaterial read_material(const TomlTable& table, std::optional<double> void_ratio = {});

} // namespace drivers
