// SPDX-License-Identifier: BSD-3-Clause
// A run: its data, and the step as a list of stages.
#pragma once
#include "host/engine/gradient.hpp"
#include "host/engine/passes.hpp"
#include "host/walls/wall_room.hpp"

namespace host {

enum class Stage { neighbours, wave_speed, deformation, motion };
inline constexpr std::array stage_names{"neighbours", "wave speed", "gradient and stress",
                                        "forces and motion"};

template <class Geometry> struct Simulation {
  Scene scene;
  Kernel<Geometry::dimension> kernel;
  Particles<Geometry> particles{};
  std::vector<Mirror> mirrors{};
  std::vector<Wall> walls{};                            ///< floor, gate and those of the list
  std::vector<Surface<Geometry::dimension>> surfaces{}; ///< theirs, if the scene has a list of walls
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
  std::vector<ClusterMotion> motions{}; ///< of the last step
  WallRoom<Geometry::dimension> wall_room{};
};

/// The scene at time 0. Throws std::runtime_error for a scene without particles.
template <class Geometry> Simulation<Geometry> start_simulation(const Scene& scene);

/// Sorts the particles and finds images and neighbours anew; `step` does so whenever a particle has moved half
/// the skin.
template <class Geometry> void update_lists(Simulation<Geometry>& simulation);

/// Bytes of all particle data, records and images, and of the neighbour lists.
struct Memory {
  std::size_t data = 0, lists = 0;
};
template <class Geometry> Memory memory_of(const Simulation<Geometry>& simulation);

/// One step. Throws std::runtime_error if the material fails.
template <class Geometry> void step(Simulation<Geometry>& simulation);

} // namespace host
