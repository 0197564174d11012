// SPDX-License-Identifier: BSD-3-Clause
// The caller's side of the VUMAT interface: arrays of one block in the order of the convention, and the call. The SPH
// engine fills blocks of 64 particles, the element driver blocks of 1 to 128 points.
#pragma once
#include "host/material/guard_words.hpp"
#include "host/material/job.hpp"
#include "host/material/kinematics.hpp"
#include "host/material/library.hpp"
#include "vumat/abi.hpp"
#include <array>
#include <string>
#include <vector>

namespace host {

/// The axes a material is called in.
enum class Frame {
  jaumann,      ///< the base axes; old stress turned by the spin of the step; F and U stay unity
  green_naghdi, ///< axes that turn with R of F = R U, as in ABAQUS; F and U carried
};

/// A material as a host knows it: a library, a name and numbers.
struct Material {
  VumatLibrary library;
  std::string name;               ///< `cmname`; passed in upper case
  std::vector<double> properties; ///< PROPS
  int state_variables = 0;        ///< STATEV per point
  Frame frame = Frame::jaumann;
  bool serial = false;           ///< not thread safe: one call at a time, blocks in order
  bool may_write_inputs = false; ///< its inputs are restored after each call instead of refused
  Job job{};                     ///< the run it is called in
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
  GuardedArray coordinates, char_length, constants, density;
  GuardedArray strain_increment, spin_increment;
  GuardedArray stretch_old, stretch_new, gradient_old, gradient_new;
  GuardedArray stress_old, stress_new;
  GuardedArray state_old, state_new;
  GuardedArray internal_energy_old, internal_energy_new;
  GuardedArray inelastic_energy_old, inelastic_energy_new;
  GuardedArray temperature_old, temperature_new, field_old, field_new;
  GuardedArray dt; ///< argument 10: an array since 2023
  std::vector<Tensor> rotation_new,
      kept_gradient;         ///< R and F at the end, for the caller; not shown to the material
  std::vector<int> elements; ///< user element number of each point; 1, 2, ... unless filled
  std::array<char, vumat::name_length> name; ///< of the material, as it is passed
  GuardedIntegers info;                      ///< argument 7, written anew for each call, as is the name
  GuardedText passed_name;
  long calls = 0;                 ///< so far
  std::vector<double> input_copy; ///< of the last call that was compared
};

/// Calls `f(name, array, is_input)` for all arrays of a block, by their names in ABAQUS. dt, which a subroutine may
/// overwrite without harm, is not counted as an input.
template <class Block, class F> void each_array(Block& b, F&& f) {
  f("coordMp", b.coordinates, true);
  f("charLength", b.char_length, true);
  f("props", b.constants, true);
  f("density", b.density, true);
  f("strainInc", b.strain_increment, true);
  f("relSpinInc", b.spin_increment, true);
  f("tempOld", b.temperature_old, true);
  f("stretchOld", b.stretch_old, true);
  f("defgradOld", b.gradient_old, true);
  f("fieldOld", b.field_old, true);
  f("stressOld", b.stress_old, true);
  f("stateOld", b.state_old, true);
  f("enerInternOld", b.internal_energy_old, true);
  f("enerInelasOld", b.inelastic_energy_old, true);
  f("tempNew", b.temperature_new, true);
  f("stretchNew", b.stretch_new, true);
  f("defgradNew", b.gradient_new, true);
  f("fieldNew", b.field_new, true);
  f("stressNew", b.stress_new, false);
  f("stateNew", b.state_new, false);
  f("enerInternNew", b.internal_energy_new, false);
  f("enerInelasNew", b.inelastic_energy_new, false);
  f("dt", b.dt, false);
}

/// Calls the material for all points of the block. New state and energies are set to the old ones before, new stress to
/// NaNs of a known pattern: what a subroutine does not write is then right, or found by first_failure. At `total_time` = 0
/// this is the data check, with an elastic response and a state that is not to be used.
/// Throws std::runtime_error, naming the material, if the subroutine throws, asks for the end (xplb_exit), writes beyond
/// an array or to a constant (checked after each call, further than 8 words beyond after some), or to another input
/// (checked after the first 16 calls of a block, then after one call in as many as it has points).
void call_vumat(const Material& material, const Increment& increment, VumatBlock& block);

} // namespace host
