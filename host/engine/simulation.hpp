// SPDX-License-Identifier: BSD-3-Clause
// A run: its data.
#pragma once
#include "host/engine/passes.hpp"
#include "host/walls/surfaces.hpp"

namespace host {

enum class Stage { neighbours, wave_speed, deformation, motion };
inline constexpr std::array stage_names{"neighbours", "wave speed", "gradient and stress",
                                        "forces and motion"};

template <class Geometry> struct Simulation {
  static constexpr int D = Geometry::dimension;
  Scene scene;
  Kernel<D> kernel;
  Particles<Geometry> particles{};
  std::vector<Wall> walls{};          ///< floor, gate and those of the list
  std::vector<Surface<D>> surfaces{}; ///< planes of symmetry and walls, at `time`
  StressBlocks blocks{};

  // Valid until particles have moved half the skin.
  Images images{};
  NeighbourLists outer_lists{};
  Records<Geometry> records{};
  double moved = 0;       ///< m, bound of what any particle has moved since
  double listed_time = 0; ///< s, when they were made

  // Valid until particles have moved half the narrow skin.
  NeighbourLists lists{};
  double moved_when_pruned = -1; ///< m, `moved` then; below 0: not pruned yet
  double pruned_time = 0;        ///< s
  long prunings = 0;             ///< since the start or the resumption

  double time = 0;                            ///< s
  double dt = 0, dt_before = 0, first_dt = 0; ///< s: this step, the last, the first as waves bound it
  double steepest = 0; ///< 1/s, largest component of the velocity gradients of the last step
  long steps = 0, rebuilds = 0;
  Work work{};
  std::vector<WallLoad> loads{}; ///< one for each of `walls`
  double initial_potential_energy = 0;
  std::array<double, stage_names.size()> stage_seconds{};
  std::vector<Surface<D>> surfaces_ahead{}; ///< at the end of the step
  MotionBuffers<D> buffers{};
};

/// The scene at time 0. Throws std::runtime_error for a scene without particles.
template <class Geometry> Simulation<Geometry> start_simulation(const Scene& scene);

/// What particles need to move in this step, `surfaces_ahead` being there. Refers to the simulation.
template <class Geometry> MotionTerms<Geometry> motion_terms(const Simulation<Geometry>& s) {
  return {{s.kernel, s.lists, s.records, s.images},
          {s.walls, s.surfaces, s.surfaces_ahead, s.images.within_reach, s.scene.spacing, s.scene.gravity},
          {s.dt_before, s.dt}};
}

/// Bytes of all particle data, records and images, and of the neighbour lists.
struct Memory {
  std::size_t data = 0, lists = 0;
};
template <class Geometry> Memory memory_of(const Simulation<Geometry>& simulation);

} // namespace host
