// SPDX-License-Identifier: BSD-3-Clause
#include "host/vumat_block.hpp"
#include <algorithm>
#include <array>
#include <cctype>

namespace host {
namespace {

/// Identity in the symmetric or non-symmetric component order: ones in the three direct components.
std::vector<double> identity(int points, int components) {
  std::vector<double> a(std::size_t(points) * components, 0.0);
  std::fill_n(a.begin(), std::size_t(points) * 3, 1.0);
  return a;
}

std::array<char, vumat::name_length> padded_upper(const std::string& name) {
  std::array<char, vumat::name_length> out;
  out.fill(' ');
  for (std::size_t c = 0; c < std::min(name.size(), out.size()); ++c)
    out[c] = char(std::toupper(static_cast<unsigned char>(name[c])));
  return out;
}

} // namespace

VumatBlock::VumatBlock(const Material& material, int points_, int shear)
    : points(points_), shear_components(shear), state_variables(material.state_variables) {
  const std::size_t n = points, symmetric = 3 + shear;
  coordinates.assign(3 * n, 0);
  for (auto* a : {&char_length, &density, &internal_energy_old, &internal_energy_new, &inelastic_energy_old,
                  &inelastic_energy_new, &temperature_old, &temperature_new})
    a->assign(n, 0);
  for (auto* a : {&strain_increment, &stress_old, &stress_new}) a->assign(n * symmetric, 0);
  spin_increment.assign(n * shear, 0);
  state_old.assign(n * state_variables, 0);
  state_new = state_old;
  stretch_old = stretch_new = identity(points, 3 + shear);
  gradient_old = gradient_new = identity(points, 3 + 2 * shear);
}

void call_vumat(const Material& material, const Increment& increment, VumatBlock& block) {
  const int direct = 3, shear = block.shear_components, states = block.state_variables, fields = 0;
  const int constants = int(material.properties.size());
  // Arguments 7 and 10 are arrays since 2023; the first entry keeps its old meaning.
  std::array<int, 8 + vumat::max_block> info{};
  std::array<double, 2 * vumat::max_block + 1> dt;
  dt.fill(increment.dt);
  const double step_time = increment.step_time, total_time = increment.total_time, no_field = 0;
  const int nblock = block.points;
  const auto name = padded_upper(material.name);

  std::copy_n(block.state_old.begin(), std::size_t(nblock) * states, block.state_new.begin());
  std::copy_n(block.internal_energy_old.begin(), nblock, block.internal_energy_new.begin());
  std::copy_n(block.inelastic_energy_old.begin(), nblock, block.inelastic_energy_new.begin());

  material.library.call(
      &nblock, &direct, &shear, &states, &fields, &constants, info.data(), &step_time, &total_time, dt.data(),
      name.data(), block.coordinates.data(), block.char_length.data(), material.properties.data(),
      block.density.data(), block.strain_increment.data(), block.spin_increment.data(),
      block.temperature_old.data(), block.stretch_old.data(), block.gradient_old.data(), &no_field,
      block.stress_old.data(), block.state_old.data(), block.internal_energy_old.data(),
      block.inelastic_energy_old.data(), block.temperature_new.data(), block.stretch_new.data(),
      block.gradient_new.data(), &no_field, block.stress_new.data(), block.state_new.data(),
      block.internal_energy_new.data(), block.inelastic_energy_new.data(), name.size());
}

} // namespace host
