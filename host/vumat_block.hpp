// SPDX-License-Identifier: BSD-3-Clause
// The caller's side of the VUMAT interface: arrays of one block in the order of the convention, and
// the call. The SPH stress stage fills a block of up to 128 particles, the element driver one point.
#pragma once
#include "host/vumat_library.hpp"
#include <string>
#include <vector>

namespace host {

/// A material as a host knows it: a library, a name, numbers. Nothing of the model itself.
struct Material {
  VumatLibrary library;
  std::string name;               ///< `cmname`; passed in upper case
  std::vector<double> properties; ///< PROPS
  int state_variables = 0;        ///< STATEV per point
};

/// Times of one increment, s; `step_time` and `total_time` at its end.
struct Increment {
  double step_time = 0, total_time = 0, dt = 0;
};

/// Arrays of one block, each component-major with the block index fastest (vumat/abi.hpp). Strain
/// and stress tension positive, shear as tensor components; stretch and deformation gradient are
/// unity unless the caller fills them.
struct VumatBlock {
  VumatBlock(const Material& material, int points, int shear_components);

  int points;           ///< nblock: 1 to vumat::max_block
  int shear_components; ///< nshr: 1 or 3
  int state_variables;
  std::vector<double> coordinates, char_length, density;
  std::vector<double> strain_increment, spin_increment;
  std::vector<double> stretch_old, stretch_new, gradient_old, gradient_new;
  std::vector<double> stress_old, stress_new;
  std::vector<double> state_old, state_new;
  std::vector<double> internal_energy_old, internal_energy_new;
  std::vector<double> inelastic_energy_old, inelastic_energy_new;
  std::vector<double> temperature_old, temperature_new;
};

/// Calls the material for all points of the block. Scalars are passed as
/// copies and new state and energies are preset to the old ones, so that a subroutine that leaves
/// them unwritten or overwrites its inputs does no harm. At `total_time` = 0 this is the data check:
/// the answer is elastic and the state must be thrown away.
void call_vumat(const Material& material, const Increment& increment, VumatBlock& block);

} // namespace host
