// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/step_size.hpp"
#include "host/engine/lists.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace host {
namespace {

/// Flow speed of the particles of cluster c, m/s.
template <class Geometry> Lane flow_speed(const Particles<Geometry>& p, int c) {
  Lane square{};
  for (const auto& velocity : p.velocity) {
    const Lane v = load(&velocity[c * lanes]);
    square += v * v;
  }
  return square_root(square);
}

/// Largest speeds of all particles; what is no number is left out.
struct Speeds {
  double sum = 0, flow = 0; ///< m/s, of wave and flow together; of the flow alone
  double hoop = 0;          ///< 1/s, axisymmetry: wave speed over radius
};
template <class Geometry> Speeds fastest_of(const Particles<Geometry>& p) {
  Lane sum{}, flow{}, hoop{};
  for (int c = 0; c < p.clusters(); ++c) {
    const Lane v = flow_speed(p, c), wave = load(&p.wave_speed[c * lanes]);
    sum = larger(wave + v, sum);
    flow = larger(v, flow);
    if constexpr (Geometry::hoop) hoop = larger(wave / load(&p.position[0][c * lanes]), hoop);
  }
  return {largest(sum), largest(flow), largest(hoop)};
}

/// Largest speed at which a wall within reach comes nearer to sand in the next `dt`, m/s.
template <class Geometry> double fastest_wall(const Simulation<Geometry>& s, double dt) {
  double fastest = 0;
  for (int w = 0; w < int(s.walls.size()); ++w) {
    const Wall& wall = s.walls[w];
    if (wall.motion.time.empty() || !in_reach(s, w)) continue;
    const auto across = [&](const WallVector& v) { return part_across(wall, Geometry::dimension - 1, v); };
    fastest = std::max(fastest, wall.motion.largest(s.time, s.time + dt, across));
  }
  return fastest;
}

/// Largest step, s, in which no wall moves on by more than may be before lists are renewed.
template <class Geometry> double step_by_walls(const Simulation<Geometry>& s, double dt) {
  double most = std::numeric_limits<double>::infinity();
  for (int w = 0; w < int(s.walls.size()); ++w) {
    const auto speed = [](const WallVector& v) { return std::hypot(v[0], v[1], v[2]); };
    const double fastest = s.walls[w].motion.largest(s.time, s.time + dt, speed);
    if (fastest > 0) most = std::min(most, free_way(s, w) / fastest);
  }
  return most;
}

[[noreturn]] void step_too_short(const auto& s, double fastest) {
  const auto& p = s.particles;
  int at = 0;
  while (at < p.count - 1 && p.wave_speed[at] + flow_speed(p, at / lanes)[at % lanes] != fastest) ++at;
  std::vector<double> place;
  for (const auto& x : p.position) place.push_back(x[at]);
  throw std::runtime_error(
      fmt::format("the motion became unstable at time {:.9g} s: the step fell to {:.3g} s (first: {:.3g} s), "
                  "particle {} at ({:.6g}) m has wave and flow speeds of {:.3g} m/s together",
                  s.time, s.dt, s.first_dt, p.id[at], fmt::join(place, ", "), fastest));
}

} // namespace

/// Step from the current wave speed; in axisymmetry also from the hoop stiffness, with which a ring of radius r swings
/// at c / r. It shrinks at once and grows slowly: a deposit that opens up for a moment shows no wave, and stiffens
/// again within a few steps. Sand in flight shows hardly any and stiffens all at once where it lands: there the way of a
/// step, its own or that of a wall towards it, bounds it, and its strain with the velocity gradients of the step before.
template <class Geometry> void choose_step(Simulation<Geometry>& s) {
  constexpr double growth = 1.02, smallest = 1e-3; // of the step before; of the first step
  constexpr double way = 0.05, strain = 0.005;     // spacings; flowing columns stay below both
  constexpr double swing = 1.3;                    // rad; 2 is the limit of a ring alone
  update_wave_speed(s.particles, s.scene.material, s.blocks, s.steps);
  const Speeds fastest = fastest_of(s.particles);
  const double growing = 1 + 0.5 * s.scene.numerics.wave_speed_tolerance; // of a modulus: at most with stress
  const double by_wave =
      std::min(s.scene.numerics.step_factor * s.kernel.h / fastest.sum, swing / fastest.hoop) / growing;
  const double flow = std::max(fastest.flow, fastest_wall(s, by_wave));
  const double by_motion =
      std::min({way * s.scene.spacing / flow, strain / s.steepest, step_by_walls(s, by_wave)});
  s.dt = std::min({by_wave, by_motion, s.steps == 0 ? by_wave : growth * s.dt});
  if (s.steps == 0) s.first_dt = by_wave;
  if (!(s.dt > smallest * s.first_dt) || !std::isfinite(s.dt)) step_too_short(s, fastest.sum);
}

template decltype(choose_step<PlaneStrain>) choose_step<PlaneStrain>;
template decltype(choose_step<Axisymmetric>) choose_step<Axisymmetric>;
template decltype(choose_step<ThreeDimensional>) choose_step<ThreeDimensional>;

} // namespace host
