// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/lists.hpp"
#include "host/engine/gradient.hpp"
#include "host/walls/sight.hpp"

namespace host {
namespace {

/// The skin of pruned lists, over that of the outer lists.
constexpr double narrow = 0.1;

template <class Geometry> double skin_of(const Simulation<Geometry>& s) {
  return s.scene.numerics.skin * s.scene.spacing;
}

template <class Geometry> void write_motion_records(Simulation<Geometry>& s) {
  show_motion(s.particles, s.records);
  reflect_motion(s.images, s.surfaces, s.records);
}

template <class Geometry>
WallVector displacement_since(const Simulation<Geometry>& s, int wall, double since) {
  const auto& motion = s.walls[wall].motion;
  WallVector way = motion.displacement(s.time);
  const auto then = motion.displacement(since);
  for (int a = 0; a < 3; ++a) way[a] -= then[a];
  return way;
}

/// How far the walls within reach have come nearer to sand since a time, m, together: images move by twice as much.
template <class Geometry> double approach_of_walls(const Simulation<Geometry>& s, double since) {
  double all = 0;
  for (int w = 0; w < int(s.walls.size()); ++w)
    if (!s.walls[w].motion.time.empty() && in_reach(s, w))
      all += part_across(s.walls[w], Geometry::dimension - 1, displacement_since(s, w, since));
  return all;
}

/// Half of the way by which particles and images may have come nearer to each other, m, when particles have moved by up
/// to `way` since a time. Behind a hollow cylinder an image moves along the wall by more than its particle.
template <class Geometry> double approach_bound(const Simulation<Geometry>& s, double way, double since) {
  double growth = 1;
  for (const int k : s.images.within_reach)
    if (const auto& surface = s.surfaces[k]; surface.mantle && surface.side < 0)
      growth = std::max(growth, (surface.radius + list_reach(s)) /
                                    std::max(surface.radius - list_reach(s), 0.1 * surface.radius));
  return 0.5 * (1 + growth) * way + approach_of_walls(s, since);
}

/// True if a wall has moved, in whatever direction, so far that sand may need images that it has not.
template <class Geometry> bool walls_moved_on(const Simulation<Geometry>& s) {
  for (int w = 0; w < int(s.walls.size()); ++w) {
    if (s.walls[w].motion.time.empty()) continue;
    const auto way = displacement_since(s, w, s.listed_time);
    if (std::hypot(way[0], way[1], way[2]) > free_way(s, w)) return true;
  }
  return false;
}

template <class Geometry> void prune_lists(Simulation<Geometry>& s) {
  prune(s.particles, s.records, s.kernel.support + narrow * skin_of(s), s.outer_lists, s.lists);
  s.moved_when_pruned = s.moved;
  s.pruned_time = s.time;
  ++s.prunings;
}

/// Sizes `records` anew; none of the old ones is kept.
template <class Record> void resize_records(std::vector<Record>& records, std::size_t size) {
  if (size > records.capacity()) {
    std::vector<Record>().swap(records);
    records.reserve(size + size / 32);
  }
  records.resize(size);
}

} // namespace

template <class Geometry> double list_reach(const Simulation<Geometry>& s) {
  return s.kernel.support + skin_of(s);
}

template <class Geometry> bool in_reach(const Simulation<Geometry>& s, int wall) {
  return std::ranges::any_of(s.images.within_reach, [&](int k) { return s.surfaces[k].wall == wall; });
}

template <class Geometry> double free_way(const Simulation<Geometry>& s, int wall) {
  double clearance = unbounded;
  for (std::size_t k = 0; k < s.surfaces.size(); ++k)
    if (s.surfaces[k].wall == wall) clearance = std::min(clearance, s.images.clearance[k]);
  return std::max(0.5 * list_reach(s), clearance - list_reach(s));
}

template <class Geometry> void update_lists(Simulation<Geometry>& s) {
  const double reach = list_reach(s), skin = skin_of(s);
  sort_particles(s.particles, 0.25 * s.scene.spacing);
  find_images(s.particles, s.surfaces, reach, skin, s.images);
  const std::size_t size = s.particles.padded() + s.images.list.size();
  resize_records(s.records.motion, size);
  resize_records(s.records.stress, size);
  write_motion_records(s);
  find_neighbours(s.particles, s.images, s.records, reach, s.outer_lists,
                  find_screened_clusters(s.particles, s.surfaces, s.images, reach, skin));
  s.moved = 0;
  s.listed_time = s.time;
  ++s.rebuilds;
  prune_lists(s);
  find_sight(s.particles, s.surfaces, s.images, s.records, s.lists);
}

template <class Geometry> void update_neighbours(Simulation<Geometry>& s) {
  const int planes = planes_of_symmetry(s.scene);
  find_surfaces(planes, s.walls, s.scene.geometry, s.time, s.dt_before, s.surfaces);
  const double half_skin = 0.5 * skin_of(s);
  if (s.rebuilds == 0 || approach_bound(s, s.moved, s.listed_time) > half_skin || walls_moved_on(s))
    return update_lists(s);
  write_motion_records(s);
  if (s.moved_when_pruned < 0 ||
      approach_bound(s, s.moved - s.moved_when_pruned, s.pruned_time) > narrow * half_skin)
    prune_lists(s);
  find_sight(s.particles, s.surfaces, s.images, s.records, s.lists);
}

template decltype(list_reach<PlaneStrain>) list_reach<PlaneStrain>;
template decltype(list_reach<Axisymmetric>) list_reach<Axisymmetric>;
template decltype(list_reach<ThreeDimensional>) list_reach<ThreeDimensional>;
template decltype(in_reach<PlaneStrain>) in_reach<PlaneStrain>;
template decltype(in_reach<Axisymmetric>) in_reach<Axisymmetric>;
template decltype(in_reach<ThreeDimensional>) in_reach<ThreeDimensional>;
template decltype(free_way<PlaneStrain>) free_way<PlaneStrain>;
template decltype(free_way<Axisymmetric>) free_way<Axisymmetric>;
template decltype(free_way<ThreeDimensional>) free_way<ThreeDimensional>;
template decltype(update_lists<PlaneStrain>) update_lists<PlaneStrain>;
template decltype(update_lists<Axisymmetric>) update_lists<Axisymmetric>;
template decltype(update_lists<ThreeDimensional>) update_lists<ThreeDimensional>;
template decltype(update_neighbours<PlaneStrain>) update_neighbours<PlaneStrain>;
template decltype(update_neighbours<Axisymmetric>) update_neighbours<Axisymmetric>;
template decltype(update_neighbours<ThreeDimensional>) update_neighbours<ThreeDimensional>;

} // namespace host
