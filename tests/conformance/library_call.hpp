// SPDX-License-Identifier: BSD-3-Clause
// All 33 arguments of a call to a VUMAT in a loaded library, in either precision, with guard words around what it
// may write and copies of what it may only read.
#pragma once
#include "vumat/abi.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <dlfcn.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace conformance {

namespace statev = simsand::statev;
inline constexpr int own_states = int(simsand::state_variables.size());

/// The library of the build with this name and its subroutine; stays loaded.
template <class Real> vumat::Subroutine<Real>* load(const std::string& name, const char* symbol = "vumat_") {
  const std::string path = std::string(SIMSAND_BINARY_DIR) + "/" + name;
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* found = library ? dlsym(library, symbol) : nullptr;
  if (!found) throw std::runtime_error(dlerror());
  return reinterpret_cast<vumat::Subroutine<Real>*>(found);
}

/// The product's library of this precision.
template <class Real> vumat::Subroutine<Real>* product() {
  return load<Real>(sizeof(Real) == 4 ? "libsimsand_vumat_sp.so" : "libsimsand_vumat.so");
}

/// An array between guard words, which also fill it where nothing was written yet.
template <class Real> class Guarded {
public:
  static constexpr int guards = 64;

  void resize(std::size_t count, Real guard = Real(-12345.678)) {
    guard_ = guard;
    words_.assign(count + 2 * guards, guard);
  }
  /// Other guard words around the same values.
  void surround(Real guard) {
    guard_ = guard;
    std::fill_n(words_.begin(), guards, guard);
    std::fill_n(words_.end() - guards, guards, guard);
  }
  Real* data() { return words_.data() + guards; }
  const Real* data() const { return words_.data() + guards; }
  std::size_t size() const { return words_.size() - 2 * guards; }
  Real& operator[](std::size_t i) { return data()[i]; }
  Real operator[](std::size_t i) const { return data()[i]; }
  Real* begin() { return data(); }
  Real* end() { return data() + size(); }
  const Real* begin() const { return data(); }
  const Real* end() const { return data() + size(); }
  void fill(Real value) { std::fill(begin(), end(), value); }
  void copy_values(const Guarded& b) { std::copy(b.begin(), b.end(), begin()); }

  /// Whether nothing was written outside.
  bool intact() const {
    const auto untouched = [this](Real word) { return word == guard_; };
    return std::all_of(words_.begin(), words_.begin() + guards, untouched) &&
           std::all_of(words_.end() - guards, words_.end(), untouched);
  }
  /// Whether every entry was written.
  bool all_written() const {
    return std::none_of(begin(), end(), [this](Real word) { return word == guard_; });
  }
  bool same_bits(const Guarded& b) const {
    return words_.size() == b.words_.size() &&
           std::memcmp(words_.data(), b.words_.data(), words_.size() * sizeof(Real)) == 0;
  }

private:
  std::vector<Real> words_;
  Real guard_ = 0;
};

/// The arguments, named as in abi.hpp.
template <class Real> struct Arguments {
  int nblock, ndir = 3, nshr, nstatev, nfieldv = 2, nprops = 0;
  std::vector<int> jInfoArray;
  Real stepTime = 1, totalTime = 1;
  std::array<char, vumat::name_length> cmname{};
  Guarded<Real> dtArray, coordMp, charLength, props, density, strainInc, relSpinInc, tempOld, stretchOld,
      defgradOld, fieldOld, stressOld, stateOld, enerInternOld, enerInelasOld, tempNew, stretchNew,
      defgradNew, fieldNew;
  Guarded<Real> stressNew, stateNew, enerInternNew, enerInelasNew;

  Arguments(int points, int shear, int states, const std::vector<double>& properties)
      : nblock(points), nshr(shear), nstatev(states), nprops(int(properties.size())) {
    const std::size_t n = points, symmetric = n * (3 + shear), full = n * (3 + 2 * shear);
    jInfoArray.assign(8 + n, -1); // entries beyond the first are not the annealing flag
    jInfoArray[0] = 0;
    set_name("SIMSAND-1");
    const auto set = [](Guarded<Real>& a, std::size_t count, Real value) {
      a.resize(count);
      a.fill(value);
    };
    set(dtArray, 2 * n + 1, std::numeric_limits<Real>::quiet_NaN());
    dtArray[0] = Real(1e-5);
    set(coordMp, 3 * n, 0);
    for (auto* a : {&charLength, &enerInternOld, &enerInelasOld, &tempOld, &tempNew}) set(*a, n, 0);
    set(density, n, 1600);
    props.resize(properties.size());
    std::transform(properties.begin(), properties.end(), props.begin(), [](double x) { return Real(x); });
    for (auto* a : {&strainInc, &stressOld}) set(*a, symmetric, 0);
    for (auto* a : {&stretchOld, &stretchNew}) set(*a, symmetric, 1);
    for (auto* a : {&defgradOld, &defgradNew}) set(*a, full, 1);
    set(relSpinInc, n * shear, 0);
    for (auto* a : {&fieldOld, &fieldNew}) set(*a, n * nfieldv, 0);
    set(stateOld, n * states, 0);
    clear_outputs();
  }

  void set_name(const std::string& name) {
    cmname.fill(' ');
    std::copy(name.begin(), name.end(), cmname.begin());
  }

  /// Outputs that hold nothing yet.
  void clear_outputs() {
    constexpr Real guard = Real(98765.4321);
    stressNew.resize(stressOld.size(), guard);
    stateNew.resize(stateOld.size(), guard);
    for (auto* a : {&enerInternNew, &enerInelasNew}) a->resize(nblock, guard);
  }

  void call(vumat::Subroutine<Real>* subroutine) {
    subroutine(&nblock, &ndir, &nshr, &nstatev, &nfieldv, &nprops, jInfoArray.data(), &stepTime, &totalTime,
               dtArray.data(), cmname.data(), coordMp.data(), charLength.data(), props.data(), density.data(),
               strainInc.data(), relSpinInc.data(), tempOld.data(), stretchOld.data(), defgradOld.data(),
               fieldOld.data(), stressOld.data(), stateOld.data(), enerInternOld.data(), enerInelasOld.data(),
               tempNew.data(), stretchNew.data(), defgradNew.data(), fieldNew.data(), stressNew.data(),
               stateNew.data(), enerInternNew.data(), enerInelasNew.data(), cmname.size());
  }

  std::array<const Guarded<Real>*, 4> outputs() const {
    return {&stressNew, &stateNew, &enerInternNew, &enerInelasNew};
  }
  template <class Self> static auto inputs(Self& a) {
    return std::array{&a.dtArray,       &a.coordMp,       &a.charLength, &a.props,      &a.density,
                      &a.strainInc,     &a.relSpinInc,    &a.tempOld,    &a.stretchOld, &a.defgradOld,
                      &a.fieldOld,      &a.stressOld,     &a.stateOld,   &a.tempNew,    &a.stretchNew,
                      &a.enerInternOld, &a.enerInelasOld, &a.defgradNew, &a.fieldNew};
  }
  bool outputs_equal(const Arguments& b) const {
    const auto mine = outputs(), others = b.outputs();
    return std::equal(mine.begin(), mine.end(), others.begin(),
                      [](auto* x, auto* y) { return x->same_bits(*y); });
  }
  bool inputs_equal(const Arguments& b) const {
    const auto mine = inputs(*this), others = inputs(b);
    return nblock == b.nblock && ndir == b.ndir && nshr == b.nshr && nstatev == b.nstatev &&
           nfieldv == b.nfieldv && nprops == b.nprops && jInfoArray == b.jInfoArray &&
           stepTime == b.stepTime && totalTime == b.totalTime && cmname == b.cmname &&
           std::equal(mine.begin(), mine.end(), others.begin(),
                      [](auto* x, auto* y) { return x->same_bits(*y); });
  }

  /// Makes the new values the old ones.
  void advance() {
    stressOld.copy_values(stressNew);
    stateOld.copy_values(stateNew);
    enerInternOld.copy_values(enerInternNew);
    enerInelasOld.copy_values(enerInelasNew);
    clear_outputs();
  }
};

/// Table 4: spheres, tetrahedra, elongated grains; e0 between the dense and the loose packing.
struct Grains {
  double phi, e_ref, dense, loose;
};
inline constexpr std::array<Grains, 3> grains{
    {{18.5, 0.76, 0.58, 0.70}, {24, 0.76, 0.44, 0.72}, {26, 0.74, 0.448, 0.70}}};

inline std::vector<double> properties(const Grains& g, double e0) {
  return {100, 0.2, 0.51, g.phi, g.e_ref, 0.04, 0.3, 1, 0.0015, 3.3, 1, e0, 101325, 0};
}

/// Random points: mean stress 1 Pa to 1 MPa, stress ratio up to half of the strength's order, void ratio 0.4 to 0.9,
/// some parted, some at their first update; increments of size 1e-8 to 1e-2 in all directions. The numbers are
/// floats, so that both precisions get the same.
template <class Real> void set_random(Arguments<Real>& a, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const int n = a.nblock;
  for (int k = 0; k < n; ++k) {
    const double p = std::pow(10, 6 * uniform(random)), ratio = 0.2 * uniform(random);
    const double size = std::pow(10, -8 + 6 * uniform(random)), kind = uniform(random);
    for (int c = 0; c < 3 + a.nshr; ++c) {
      a.strainInc[c * n + k] = float(size * normal(random));
      a.stressOld[c * n + k] = float(p * ((c < 3 ? -1 : 0) + ratio * normal(random)));
    }
    const bool parted = kind<0.1, first = kind> 0.9;
    if (parted)
      for (int c = 0; c < 3 + a.nshr; ++c) a.stressOld[c * n + k] = 0;
    a.stateOld[statev::void_ratio * n + k] = first ? 0 : float(0.4 + 0.5 * uniform(random));
    a.stateOld[statev::plastic_deviatoric_strain * n + k] =
        first ? 0 : float(std::pow(10, -5 + 4 * uniform(random)));
    a.stateOld[statev::separation_strain * n + k] = parted ? float(size * uniform(random)) : 0;
    for (int c = own_states; c < a.nstatev; ++c) a.stateOld[c * n + k] = Real(100 * c + k);
    a.enerInternOld[k] = float(uniform(random));
    a.enerInelasOld[k] = float(uniform(random));
    a.density[k] = float(1000 + 1000 * uniform(random));
  }
}

} // namespace conformance
