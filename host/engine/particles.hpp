// SPDX-License-Identifier: BSD-3-Clause
// Particle data, an array for each quantity, split by lifetime. Arrays are padded to a multiple of `lanes` and sorted in
// space, so that the eight particles of a cluster are neighbours.
#pragma once
#include "host/scheme/lane.hpp"
#include <Eigen/Core>
#include <array>
#include <vector>

namespace host {

using Array = std::vector<double, Eigen::aligned_allocator<double>>;

/// Coordinate of the padding, m: outside of every support, and finite.
inline constexpr double nowhere = 1e30;

template <class Geometry> struct Particles {
  static constexpr int D = Geometry::dimension, S = Geometry::stress_components;

  int count = 0; ///< particles; arrays hold `padded()` entries
  int padded() const { return (count + lanes - 1) / lanes * lanes; }
  int clusters() const { return padded() / lanes; }

  // Persistent: part of a checkpoint.
  std::vector<int> id; ///< order of creation
  std::array<Array, D> position, velocity;
  Array mass, density;                     ///< kg (per `depth` of plane strain: kg/m), kg/m3
  std::array<Array, S> stress;             ///< Pa, Cauchy, tension positive
  std::vector<Array> state;                ///< STATEV, one array for each variable
  Array internal_energy, inelastic_energy; ///< J/kg
  Array wave_speed;                        ///< m/s
  Array checked_square;                    ///< Pa2, square of the stress for which the wave speed was found
  /// F in the non-symmetric order of the VUMAT; empty unless the material asks for it (corotational.hpp).
  std::vector<Array> deformation_gradient;

  // Per step: written by one stage, read by the next.
  Array diffusivity; ///< m2/s, of stress

  /// Calls `f(array)` for each persistent array: all that is sorted, stored and restored.
  template <class F> void each_persistent(F&& f) { each_persistent_of(*this, f); }
  template <class F> void each_persistent(F&& f) const { each_persistent_of(*this, f); }

  /// Sizes all arrays for `n` particles and `state_variables`, filled with zeros.
  void resize(int n, int state_variables) {
    count = n;
    id.assign(padded(), -1);
    state.resize(state_variables);
    each_persistent([&](Array& a) { a.assign(padded(), 0.0); });
    diffusivity.assign(padded(), 0.0);
    for (int i = count; i < padded(); ++i) {
      for (int a = 0; a < D; ++a) position[a][i] = nowhere;
      density[i] = mass[i] = wave_speed[i] = 1;
    }
  }

private:
  template <class Self, class F> static void each_persistent_of(Self& p, F&& f) {
    for (auto* group : {&p.position, &p.velocity})
      for (auto& a : *group) f(a);
    for (auto* a :
         {&p.mass, &p.density, &p.internal_energy, &p.inelastic_energy, &p.wave_speed, &p.checked_square})
      f(*a);
    for (auto& a : p.stress) f(a);
    for (auto& a : p.state) f(a);
    for (auto& a : p.deformation_gradient) f(a);
  }
};

} // namespace host
