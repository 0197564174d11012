// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/material_library.hpp"
#include "host/material/library.hpp"
#include "vumat/parameters.hpp"
#include <dlfcn.h>
#include <fmt/format.h>
#include <stdexcept>

namespace charts {
namespace {

constexpr int states = int(simsand::state_variables.size());
namespace statev = simsand::statev;

} // namespace

template <class Real>
LibraryBlock<Real>::LibraryBlock(int points_, int shear_) : points(points_), shear(shear_) {
  const std::size_t n = points;
  for (auto* a : {&strain, &stress_old, &stress_new}) a->assign(n * components(), 0);
  for (auto* a : {&state_old, &state_new}) a->assign(n * states, 0);
  for (auto* a : {&internal_old, &internal_new, &inelastic_old, &inelastic_new}) a->assign(n, 0);
  density.assign(n, 1); // energies per volume
}

template <class Real>
void LibraryBlock<Real>::put(int k, const Point& point, const Tensor& strain_increment) {
  for (int c = 0; c < components(); ++c) {
    strain[c * points + k] = Real(-strain_increment[c]);
    stress_old[c * points + k] = Real(-point.stress[c]);
  }
  const auto set = [&](int index, double value) { state_old[index * points + k] = Real(value); };
  set(statev::void_ratio, point.void_ratio);
  set(statev::plastic_deviatoric_strain, point.plastic_strain);
  set(statev::separation_strain, point.separation_strain);
  set(statev::status, 0);
  set(statev::nonconvex_updates, 0);
}

namespace {

template <class Real>
Point point_of(const std::vector<Real>& stress, const std::vector<Real>& states_of_all, int points, int k) {
  Point point;
  for (int c = 0; c * points < int(stress.size()); ++c) point.stress[c] = -double(stress[c * points + k]);
  const auto state = [&](int index) { return double(states_of_all[index * points + k]); };
  point.void_ratio = state(statev::void_ratio);
  point.plastic_strain = state(statev::plastic_deviatoric_strain);
  point.separation_strain = state(statev::separation_strain);
  return point;
}

} // namespace

template <class Real> Point LibraryBlock<Real>::get(int k) const {
  return point_of(stress_new, state_new, points, k);
}

template <class Real> void LibraryBlock<Real>::given(int k, Point& point, Tensor& strain_increment) const {
  point = point_of(stress_old, state_old, points, k);
  for (int c = 0; c < components(); ++c) strain_increment[c] = -double(strain[c * points + k]);
}

template <class Real> int LibraryBlock<Real>::status(int k) const {
  return int(state_new[statev::status * points + k]);
}

template <class Real> void LibraryBlock<Real>::advance() {
  stress_old = stress_new;
  state_old = state_new;
  internal_old = internal_new;
  inelastic_old = inelastic_new;
}

template <class Real>
void LibraryBlock<Real>::call(vumat::Subroutine<Real>* subroutine, std::span<const Real> props) {
  const int direct = 3, fields = 0, constants = int(props.size()), annealing = 0;
  const Real time = 1, step = Real(1e-5);
  std::array<char, vumat::name_length> name;
  name.fill(' ');
  subroutine(&points, &direct, &shear, &states, &fields, &constants, &annealing, &time, &time, &step,
             name.data(), nullptr, nullptr, props.data(), density.data(), strain.data(), nullptr, nullptr,
             nullptr, nullptr, nullptr, stress_old.data(), state_old.data(), internal_old.data(),
             inelastic_old.data(), nullptr, nullptr, nullptr, nullptr, stress_new.data(), state_new.data(),
             internal_new.data(), inelastic_new.data(), name.size());
}

template <class Real> vumat::Subroutine<Real>* material_library(std::string path) {
  if (path.empty())
    path = host::beside_program(sizeof(Real) == 4 ? "libsimsand_vumat_sp.so" : "libsimsand_vumat.so");
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* symbol = library ? dlsym(library, "vumat_") : nullptr;
  if (!symbol) throw std::runtime_error(fmt::format("material library {}: {}", path, dlerror()));
  return reinterpret_cast<vumat::Subroutine<Real>*>(symbol);
}

template struct LibraryBlock<float>;
template struct LibraryBlock<double>;
template vumat::Subroutine<float>* material_library<float>(std::string);
template vumat::Subroutine<double>* material_library<double>(std::string);

} // namespace charts
