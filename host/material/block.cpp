// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/block.hpp"
#include "host/material/utilities.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <mutex>
#include <numeric>
#include <stdexcept>

namespace host {
namespace {

std::array<char, vumat::name_length> padded_upper(const std::string& name) {
  std::array<char, vumat::name_length> out;
  out.fill(' ');
  for (std::size_t c = 0; c < std::min(name.size(), out.size()); ++c)
    out[c] = char(std::toupper(static_cast<unsigned char>(name[c])));
  return out;
}

/// Sets argument 7, an array since ABAQUS 2023: annealing (its meaning before), integration point, layer, section point,
/// the flag of an effective modulus, the position from 1 of the first element number; then the element numbers.
void set_info(VumatBlock& b) {
  constexpr std::array<int, 8> head{0, 1, 1, 1, 0, 9, 0, 0};
  std::copy(head.begin(), head.end(), b.info.data());
  std::copy(b.elements.begin(), b.elements.end(), b.info.data() + head.size());
}

/// Sets outputs before a call, and the copies of inputs that a subroutine may have overwritten in the last one.
void preset(const Material& material, const Increment& increment, VumatBlock& b) {
  std::copy(b.state_old.begin(), b.state_old.end(), b.state_new.begin());
  std::copy(b.internal_energy_old.begin(), b.internal_energy_old.end(), b.internal_energy_new.begin());
  std::copy(b.inelastic_energy_old.begin(), b.inelastic_energy_old.end(), b.inelastic_energy_new.begin());
  std::fill(b.stress_new.begin(), b.stress_new.end(), unwritten_word);
  std::fill(b.dt.begin(), b.dt.end(), increment.dt);
  std::copy(material.properties.begin(), material.properties.end(), b.constants.begin());
  std::copy(b.name.begin(), b.name.end(), b.passed_name.data());
  set_info(b);
}

void invoke(const Material& material, const Increment& increment, VumatBlock& b) {
  int direct = 3, shear = b.shear_components, states = b.state_variables, fields = 0;
  int nblock = b.points, constants = int(b.constants.size());
  // Copies that are not const, since a subroutine may overwrite them.
  double step_time = increment.step_time, total_time = increment.total_time;
  material.library.call(&nblock, &direct, &shear, &states, &fields, &constants, b.info.data(), &step_time,
                        &total_time, b.dt.data(), b.passed_name.data(), b.coordinates.data(),
                        b.char_length.data(), b.constants.data(), b.density.data(), b.strain_increment.data(),
                        b.spin_increment.data(), b.temperature_old.data(), b.stretch_old.data(),
                        b.gradient_old.data(), b.field_old.data(), b.stress_old.data(), b.state_old.data(),
                        b.internal_energy_old.data(), b.inelastic_energy_old.data(), b.temperature_new.data(),
                        b.stretch_new.data(), b.gradient_new.data(), b.field_new.data(), b.stress_new.data(),
                        b.state_new.data(), b.internal_energy_new.data(), b.inelastic_energy_new.data(),
                        b.passed_name.size());
}

/// Calls the subroutine and turns every exception into an error that names the material.
void invoke_guarded(const Material& material, const Increment& increment, VumatBlock& b) {
  static std::mutex one_at_a_time;
  std::unique_lock lock(one_at_a_time, std::defer_lock);
  if (material.serial) lock.lock();
  const RunningCall running(material.name, material.job, increment.total_time);
  try {
    invoke(material, increment, b);
  } catch (const VumatExit& exit) {
    throw std::runtime_error(
        fmt::format("material {}: {} at time {:.9g} s", material.name, exit.what(), increment.total_time));
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("material {}: its subroutine threw an exception at time {:.9g} s: {}", material.name,
                    increment.total_time, error.what()));
  } catch (...) {
    throw std::runtime_error(fmt::format("material {}: its subroutine threw an exception at time {:.9g} s",
                                         material.name, increment.total_time));
  }
}

} // namespace

VumatBlock::VumatBlock(const Material& material, int points_, int shear)
    : points(points_), shear_components(shear), state_variables(material.state_variables), elements(points_),
      name(padded_upper(material.name)), info(8 + elements.size()), passed_name(name.size()) {
  std::iota(elements.begin(), elements.end(), 1);
  const auto make = [&](GuardedArray& a, int components, double value = 0) {
    a.assign(std::size_t(points) * components, value, 4 * std::size_t(points));
  };
  make(coordinates, 3);
  for (auto* a : {&char_length, &density, &internal_energy_old, &internal_energy_new, &inelastic_energy_old,
                  &inelastic_energy_new, &temperature_old, &temperature_new})
    make(*a, 1);
  for (auto* a : {&strain_increment, &stress_old, &stress_new}) make(*a, 3 + shear);
  make(spin_increment, shear);
  for (auto* a : {&state_old, &state_new}) make(*a, state_variables);
  for (auto* a : {&stretch_old, &stretch_new}) make(*a, 3 + shear);
  for (auto* a : {&gradient_old, &gradient_new}) make(*a, 3 + 2 * shear);
  for (auto* a : {&stretch_old, &stretch_new, &gradient_old, &gradient_new})
    std::fill_n(a->begin(), 3 * std::size_t(points), 1.0); // unity
  for (auto* a : {&field_old, &field_new}) make(*a, 0);
  dt.assign(2 * std::size_t(points) + 1, 0, std::size_t(points));
  constants.assign(material.properties.size(), 0, std::size_t(points));
  std::copy(material.properties.begin(), material.properties.end(), constants.begin());
}

void call_vumat(const Material& material, const Increment& increment, VumatBlock& block) {
  constexpr long first_calls = 16;
  // An odd stride, since in the SPH host every other call is a data check.
  const int stride = std::max(block.points, 8) | 1;
  preset(material, increment, block);
  const bool compared = material.may_write_inputs || block.calls < first_calls || block.calls % stride == 0;
  ++block.calls;
  if (compared) copy_inputs(block);
  invoke_guarded(material, increment, block);
  if (material.may_write_inputs) restore_inputs(block);
  check_guards(material, block, compared);
  if (compared) check_inputs(material, block);
}

} // namespace host
