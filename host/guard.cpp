// SPDX-License-Identifier: BSD-3-Clause
#include "host/guard.hpp"
#include "host/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace host {
namespace {

/// Largest component of the velocity gradient of point k, 1/s; not a number if any of them is none.
template <class Geometry> double steepest(const BlockGradient<Geometry>& gradient, int k) {
  double largest = 0;
  for (const auto& component : gradient.component) {
    const double slope = std::abs(component[k]);
    if (std::isnan(slope)) return slope;
    largest = std::max(largest, slope);
  }
  return largest;
}

template <class Geometry> double square_speed(const Particles<Geometry>& p, int i) {
  double sum = 0;
  for (const auto& v : p.velocity) sum += v[i] * v[i];
  return sum;
}

/// "particle 7 at (0.1, 0.2) m"
template <class Geometry> std::string named(const Particles<Geometry>& p, int i) {
  std::vector<double> place;
  for (const auto& x : p.position) place.push_back(x[i]);
  return fmt::format("particle {} at ({:.6g}) m", p.id[i], fmt::join(place, ", "));
}

constexpr auto advice = "a smaller numerics.step_factor may help";

} // namespace

template <class Geometry>
void check_strain(const Particles<Geometry>& p, const BlockGradient<Geometry>& gradient, int first, int count,
                  double time, double dt) {
  const double most = largest_strain_step / dt;
  bool sound = true;
  for (const auto& component : gradient.component)
    for (int k = 0; k < count; ++k) sound &= std::abs(component[k]) <= most; // false for what is no number
  if (sound) return;
  for (int k = 0; k < count; ++k)
    if (const double strain = steepest(gradient, k) * dt; !(strain <= largest_strain_step))
      throw UnsoundMotion(fmt::format("the motion became unstable at time {:.9g} s: {} strains by {:.3g} in "
                                      "one step of {:.3g} s (at most {} is sound); {}",
                                      time, named(p, first + k), strain, dt, largest_strain_step, advice));
}

template <class Geometry>
void check_energy(const Particles<Geometry>& p, double time, double made, double unclosed) {
  if (made <= largest_made_energy && std::abs(unclosed) <= largest_unclosed_energy) return;
  int fastest = 0;
  for (int i = 1; i < p.count; ++i)
    if (square_speed(p, i) > square_speed(p, fastest)) fastest = i;
  throw std::runtime_error(
      fmt::format("the energy went wrong at time {:.9g} s: {:.3g} of the initial potential energy was made "
                  "from nothing (at most "
                  "{}), {:.3g} of it is unaccounted for (at most {}); the fastest is {} with {:.3g} m/s; {}",
                  time, made, largest_made_energy, unclosed, largest_unclosed_energy, named(p, fastest),
                  std::sqrt(square_speed(p, fastest)), advice));
}

template void check_energy(const Particles<PlaneStrain>&, double, double, double);
template void check_energy(const Particles<Axisymmetric>&, double, double, double);

template void check_strain(const Particles<PlaneStrain>&, const BlockGradient<PlaneStrain>&, int, int, double,
                           double);
template void check_strain(const Particles<Axisymmetric>&, const BlockGradient<Axisymmetric>&, int, int,
                           double, double);
template void check_energy(const Particles<ThreeDimensional>&, double, double, double);
template void check_strain(const Particles<ThreeDimensional>&, const BlockGradient<ThreeDimensional>&, int,
                           int, double, double);

} // namespace host
