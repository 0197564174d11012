// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/simulation.hpp"
#include "host/bodies/initial_particles.hpp"
#include "host/material/corotational.hpp"
#include "host/scheme/geometry.hpp"
#include "host/walls/wall_contact.hpp"
#include "host/walls/wall_images.hpp"
#include <chrono>
#include <fmt/format.h>

namespace host {
namespace {

/// Runs `stage` and adds its time to the account.
template <class Geometry, class F> void timed(Simulation<Geometry>& s, Stage stage, F&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  s.stage_seconds[std::size_t(stage)] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Geometry> void show_all_motion(Simulation<Geometry>& s) {
  show_motion(s.particles, s.records);
  reflect_motion(s.images, s.mirrors, s.records);
  reflect_wall_motion(s.images, s.surfaces, s.mirrors.size(), s.records);
}

template <class Geometry> double list_reach(const Simulation<Geometry>& s) {
  return s.kernel.support + s.scene.numerics.skin * s.scene.spacing;
}

/// How far the walls of the list have moved since a time, m, together: images move by twice as much.
template <class Geometry> double wall_travel(const Simulation<Geometry>& s, double since) {
  double all = 0;
  for (const Wall& wall : s.scene.walls) {
    const auto now = wall.motion.displacement(s.time), then = wall.motion.displacement(since);
    all += std::hypot(now[0] - then[0], now[1] - then[1], now[2] - then[2]);
  }
  return all;
}

/// How far particles and images may have come towards each other, m over two, when particles have moved by up to `way`
/// since a time: behind a hollow cylinder an image moves along the wall by more than its particle.
template <class Geometry> double approach_bound(const Simulation<Geometry>& s, double way, double since) {
  double growth = 1;
  if (Geometry::dimension == 3)
    for (const Wall& wall : s.walls)
      if (wall.shape == WallShape::cylinder && wall.inside)
        growth = std::max(growth, (wall.radius + list_reach(s)) /
                                      std::max(wall.radius - list_reach(s), 0.1 * wall.radius));
  return 0.5 * (1 + growth) * way + wall_travel(s, since);
}

/// The skin of pruned lists, of the one of the outer lists.
constexpr double narrow = 0.1;

template <class Geometry> void prune_lists(Simulation<Geometry>& s) {
  const double reach = s.kernel.support + narrow * s.scene.numerics.skin * s.scene.spacing;
  prune(s.particles, s.records, reach, s.outer_lists, s.lists);
  s.moved_when_pruned = s.moved;
  s.pruned_time = s.time;
  ++s.prunings;
}

template <class Geometry> void update_neighbours(Simulation<Geometry>& s) {
  move_gate(s.mirrors, s.scene, s.time);
  if (!s.surfaces.empty()) find_surfaces(s.walls, s.scene.geometry, s.time, s.dt_before, s.surfaces);
  const double half_skin = 0.5 * s.scene.numerics.skin * s.scene.spacing;
  if (s.rebuilds == 0 || approach_bound(s, s.moved, s.listed_time) > half_skin) return update_lists(s);
  show_all_motion(s);
  if (s.moved_when_pruned < 0 ||
      approach_bound(s, s.moved - s.moved_when_pruned, s.pruned_time) > narrow * half_skin)
    prune_lists(s);
}

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

/// Of the walls of the list in the next `dt`, m/s.
double fastest_wall(const Scene& scene, double time, double dt) {
  double fastest = 0;
  for (const Wall& wall : scene.walls) fastest = std::max(fastest, wall.motion.fastest(time, time + dt));
  return fastest;
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

/// Step from the current wave speed; in axisymmetry also from the hoop stiffness, with which a ring of radius r swings
/// at c / r. It shrinks at once and grows slowly: a deposit that opens up for a moment shows no wave, and stiffens
/// again within a few steps. Sand in flight shows hardly any and stiffens all at once where it lands: there the way of a
/// step, its own or that of a wall, bounds it, and its strain with the velocity gradients of the step before.
template <class Geometry> void choose_step(Simulation<Geometry>& s) {
  constexpr double growth = 1.02, smallest = 1e-3; // of the step before; of the first step
  constexpr double way = 0.05, strain = 0.005;     // spacings; flowing columns stay below both
  constexpr double swing = 1.3;                    // rad; 2 is the limit of a ring alone
  update_wave_speed(s.particles, s.scene.material, s.blocks, s.steps);
  const Speeds fastest = fastest_of(s.particles);
  const double growing = 1 + 0.5 * s.scene.numerics.wave_speed_tolerance; // of a modulus: at most with stress
  const double by_wave =
      std::min(s.scene.numerics.step_factor * s.kernel.h / fastest.sum, swing / fastest.hoop) / growing;
  const double flow = std::max(fastest.flow, fastest_wall(s.scene, s.time, by_wave));
  const double by_motion = std::min(way * s.scene.spacing / flow, strain / s.steepest);
  s.dt = std::min({by_wave, by_motion, s.steps == 0 ? by_wave : growth * s.dt});
  if (s.steps == 0) s.first_dt = by_wave;
  if (!(s.dt > smallest * s.first_dt) || !std::isfinite(s.dt)) step_too_short(s, fastest.sum);
}

/// Adds to the loads of floor and gate, or to those of all walls.
template <class Geometry> ClusterMotion move_particles(Simulation<Geometry>& s) {
  if (!s.surfaces.empty()) return move_among_walls(s);
  const auto motion =
      move(s.particles, s.kernel, s.lists, s.scene, s.mirrors, s.dt_before, s.dt, s.records, s.motions);
  for (std::size_t w = 0; w < std::min(s.loads.size(), motion.load.size()); ++w)
    s.loads[w].add(motion.load[w]);
  return motion;
}

/// Room for `size` records; none of the old ones is kept.
template <class Record> void make_room(std::vector<Record>& records, std::size_t size) {
  if (size > records.capacity()) {
    std::vector<Record>().swap(records);
    records.reserve(size + size / 32);
  }
  records.resize(size);
}

} // namespace

template <class Geometry> Simulation<Geometry> start_simulation(const Scene& scene) {
  Simulation<Geometry> s{.scene = scene,
                         .kernel = Kernel<Geometry::dimension>(
                             scene.numerics.smoothing_length * scene.spacing, scene.numerics.kernel)};
  s.particles = initial_particles<Geometry>(scene);
  s.mirrors = scene_mirrors(scene);
  s.walls = all_walls(scene);
  s.loads.resize(s.walls.size());
  if (!scene.walls.empty()) find_surfaces(s.walls, scene.geometry, 0, 0, s.surfaces);
  s.blocks = make_stress_blocks(scene.material, s.particles, scene.spacing);
  s.blocks.dispersed_density = 0.5 * scene.bulk_density;
  s.blocks.failure_state = scene.failure_state;
  s.blocks.wave_speed_tolerance = scene.numerics.wave_speed_tolerance;
  if (scene.material.frame == Frame::green_naghdi) carry_deformation(s.particles);
  // The data check comes first, with initial stress and state in place; its answer is thrown away.
  update_wave_speed(s.particles, scene.material, s.blocks);
  // An increment without strain, so that the material's own initial state is there from the start: particles without
  // neighbours have no velocity gradient.
  constexpr double instant = 1e-12; // s
  const std::vector<int> none(s.particles.clusters(), 0);
  s.records.stress.resize(s.particles.padded());
  deform(s.particles, s.kernel, {0, {}, none, none}, medium_of(scene), scene.material,
         {instant, instant, instant}, s.blocks, s.records);
  s.initial_potential_energy = potential_energy(s.particles, scene.gravity);
  return s;
}

template <class Geometry> void update_lists(Simulation<Geometry>& s) {
  sort_particles(s.particles, 0.25 * s.scene.spacing);
  s.images = find_images(s.particles, s.mirrors, list_reach(s));
  if (!s.surfaces.empty())
    add_wall_images(s.particles, s.surfaces, s.mirrors.size(), list_reach(s), s.images);
  const std::size_t size = s.particles.padded() + s.images.list.size();
  make_room(s.records.motion, size);
  make_room(s.records.stress, size);
  show_all_motion(s);
  find_neighbours(s.particles, s.images, s.records, list_reach(s), s.outer_lists);
  s.moved = 0;
  s.listed_time = s.time;
  ++s.rebuilds;
  prune_lists(s);
}

template <class Geometry> Memory memory_of(const Simulation<Geometry>& s) {
  const auto bytes = [](const auto& array) { return array.size() * sizeof(array[0]); };
  Memory memory;
  const auto count = [&](const Array& array) { memory.data += bytes(array); };
  s.particles.each_persistent(count);
  count(s.particles.diffusivity);
  memory.data += bytes(s.particles.id) + bytes(s.records.motion) + bytes(s.records.stress) +
                 bytes(s.images.list) + bytes(s.blocks.outdated) + bytes(s.motions);
  for (const NeighbourLists* lists : {&s.outer_lists, &s.lists})
    memory.lists += bytes(lists->entries) + bytes(lists->interior) + bytes(lists->total);
  return memory;
}

template <class Geometry> void step(Simulation<Geometry>& s) {
  timed(s, Stage::neighbours, [&] { update_neighbours(s); });
  timed(s, Stage::wave_speed, [&] { choose_step(s); });
  timed(s, Stage::deformation, [&] {
    const Increment increment{s.time + s.dt, s.time + s.dt, s.dt};
    s.steepest = deform(s.particles, s.kernel, s.lists, medium_of(s.scene), s.scene.material, increment,
                        s.blocks, s.records);
    reflect_stress(s.images, s.mirrors, s.records);
    reflect_wall_stress(s.images, s.surfaces, s.mirrors.size(), s.scene, s.records);
  });
  timed(s, Stage::motion, [&] {
    const auto motion = move_particles(s);
    s.work.add(motion.work);
    s.moved += std::sqrt(motion.square);
  });
  s.time += s.dt;
  s.dt_before = s.dt;
  ++s.steps;
}

template Simulation<PlaneStrain> start_simulation(const Scene&);
template Simulation<Axisymmetric> start_simulation(const Scene&);
template Simulation<ThreeDimensional> start_simulation(const Scene&);
template void update_lists(Simulation<PlaneStrain>&);
template void update_lists(Simulation<Axisymmetric>&);
template void update_lists(Simulation<ThreeDimensional>&);
template Memory memory_of(const Simulation<PlaneStrain>&);
template Memory memory_of(const Simulation<Axisymmetric>&);
template Memory memory_of(const Simulation<ThreeDimensional>&);
template void step(Simulation<PlaneStrain>&);
template void step(Simulation<Axisymmetric>&);
template void step(Simulation<ThreeDimensional>&);

} // namespace host
