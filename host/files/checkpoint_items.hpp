// SPDX-License-Identifier: BSD-3-Clause
// What a checkpoint holds, named once for writing and reading.
#pragma once
#include "host/files/checkpoint.hpp"
#include <fmt/format.h>

namespace host {

/// Calls `item(name, value)` for all that a step reads and no stage of it writes first. Values are numbers
/// or vectors.
template <class Geometry, class F> void each_stored_item(Simulation<Geometry>& s, F&& item) {
  item("time", s.time);
  item("dt", s.dt);
  item("dt_before", s.dt_before);
  item("first_dt", s.first_dt);
  item("steepest", s.steepest);
  item("steps", s.steps);
  item("rebuilds", s.rebuilds);
  item("initial_potential_energy", s.initial_potential_energy);
  for (std::size_t k = 0; k < s.stage_seconds.size(); ++k)
    item("stage_seconds_" + std::to_string(k), s.stage_seconds[k]);

  static_assert(sizeof(Work) == 5 * 8, "a new member of Work belongs in the list below");
  item("work_stress", s.work.stress);
  item("work_viscosity", s.work.viscosity);
  item("work_wall", s.work.wall);
  item("work_friction", s.work.friction);
  item("work_guarded", s.work.guarded);

  int wall = 0;
  for (WallLoad& load : s.loads) {
    const auto name = fmt::format("wall_{}_", wall++);
    for (int a = 0; a < 3; ++a) item(fmt::format("{}impulse_{}", name, a), load.impulse[a]);
    item(name + "normal", load.normal);
    item(name + "work", load.work);
    item(name + "given", load.given);
  }

  item("particle_id", s.particles.id);
  int array = 0;
  s.particles.each_persistent([&](Array& a) { item("particle_" + std::to_string(array++), a); });
  item("moved", s.moved);

  item("listed_time", s.listed_time);
  item("list_capacity", s.outer_lists.capacity);
  item("list_entries", s.outer_lists.entries);
  item("list_interior", s.outer_lists.interior);
  item("list_total", s.outer_lists.total);
  item("list_screened", s.outer_lists.screened);
  item("surface_clearance", s.images.clearance);
  item("image_first", s.images.first);
  item("image_first_wall", s.images.first_wall);
  static_assert(sizeof(Image) == 2 * sizeof(int), "images are stored as pairs of numbers");
  std::vector<int> pairs; // source, surface
  for (const Image& image : s.images.list) pairs.insert(pairs.end(), {image.source, image.surface});
  item("images", pairs);
  s.images.list.resize(pairs.size() / 2);
  for (std::size_t k = 0; k < s.images.list.size(); ++k) s.images.list[k] = {pairs[2 * k], pairs[2 * k + 1]};
}

/// The same for what the run remembers.
template <class F> void each_stored_item(RunProgress& p, F&& item) {
  item("next_sample", p.next_sample);
  item("next_snapshot", p.next_snapshot);
  item("last_snapshot", p.last_snapshot);
  item("rest_time", p.rest_time);
  item("wall_seconds", p.spent.wall);
  item("processor_seconds", p.spent.processor);
  item("snapshots", p.result.snapshots);
  item("lost_snapshots", p.result.lost);
  int columns = int(p.result.series.size());
  item("columns", columns);
  p.result.series.resize(std::size_t(columns));
  for (std::size_t c = 0; c < p.result.series.size(); ++c)
    item("series_" + std::to_string(c), p.result.series[c]);
}

} // namespace host
