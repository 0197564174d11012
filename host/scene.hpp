// SPDX-License-Identifier: BSD-3-Clause
// What is to be simulated, in SI units: all that start_simulation (host/engine/simulation.hpp) needs. The reader of scene
// files (drivers/files/scene_file.hpp) fills it; a program may fill it by itself. Stress is effective, tension positive.
#pragma once
#include "host/bodies/column.hpp"
#include "host/material/block.hpp"
#include "host/scheme/kernel.hpp"
#include "host/scheme/medium.hpp"
#include "host/walls/wall.hpp"
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace host {

enum class GeometryKind { plane_strain, axisymmetric, three_dimensional };

/// What is simulated in three dimensions: all of space, x >= 0, or x >= 0 and y >= 0.
enum class Sector { full, half, quarter };

/// Number of vertical planes of symmetry: x = 0, then y = 0.
inline int symmetry_planes(Sector sector) {
  return sector == Sector::full ? 0 : (sector == Sector::half ? 1 : 2);
}

/// Part of a body that is symmetric about the vertical axis.
inline double fraction(Sector sector) {
  return 1.0 / (1 << symmetry_planes(sector));
}

struct Floor {
  bool present = true;
  bool no_slip = false;
  double friction = 0; ///< Coulomb coefficient where slip is allowed
};

enum class GateMotion { fixed, lift, remove };

/// Rigid, frictionless retaining wall around the sand: a cylinder, in plane strain a plane.
struct Gate {
  GateMotion motion = GateMotion::lift;
  double speed = 0;  ///< m/s, upwards
  double radius = 0; ///< m, distance from the axis
};

/// Numerical choices. The defaults are recommended; what others do: host/SCHEME.md.
struct Numerics {
  KernelKind kernel = KernelKind::wendland_c2;
  double smoothing_length = 1.5;      ///< in spacings
  double viscosity = 0.05;            ///< alpha of the artificial viscosity: times the wave speed
  double flow_viscosity = 25;         ///< beta: times smoothing length and velocity gradient
  double stress_diffusion = 5;        ///< in smoothing lengths squared per unit strain
  double step_factor = 0.4;           ///< step = factor * h / (wave speed + flow speed)
  double wave_speed_tolerance = 0.02; ///< relative change of stress up to which a wave speed is kept
  double skin = 0.4;                  ///< of the neighbour lists, in spacings
};

struct Scene {
  GeometryKind geometry = GeometryKind::axisymmetric;
  Sector sector = Sector::full; ///< what of three dimensions is simulated
  bool symmetric = true;        ///< in the plane: x = 0 is a plane of symmetry and x >= 0 is simulated
  double spacing = 0;           ///< m, initial distance of particles
  double gravity = 0;           ///< m/s2
  Column column;                ///< the sand at the start
  Material material;
  std::vector<std::string> state_names; ///< one for each state variable
  std::vector<double> initial_state;    ///< STATEV of every particle at the start
  int failure_state =
      -1; ///< position in STATEV, from 0, that is negative after a failed update; -1: there is none
  double bulk_density = 0;         ///< kg/m3, initial
  double earth_pressure_ratio = 0; ///< K0: horizontal over vertical initial stress
  double friction_angle = 0;       ///< degrees, critical state; 0 where the material has none
  Floor floor;
  Gate gate;
  std::vector<Wall> walls; ///< beside floor and gate
  Numerics numerics;
  double end_time = 0;             ///< s, latest end
  double rest_fraction = 0;        ///< at rest when kinetic energy / initial potential energy is below it
  double sample_interval = 0;      ///< s, of the series
  double snapshot_interval = 0;    ///< s, of all particles
  double checkpoint_interval = 60; ///< s of wall clock
  double grain_diameter = 0;       ///< m; the front is where the deposit is this high
  std::string output_folder;
  std::string resolved; ///< the scene file with every key written out
};

/// Number of planes of symmetry; the axis of axisymmetry is one.
inline int planes_of_symmetry(const Scene& scene) {
  if (scene.geometry == GeometryKind::three_dimensional) return symmetry_planes(scene.sector);
  return scene.symmetric ? 1 : 0;
}

/// What the terms of the scheme need of a scene.
inline Medium medium_of(const Scene& scene) {
  const Numerics& n = scene.numerics;
  return {.reference_density = scene.bulk_density,
          .gravity = scene.gravity,
          .earth_pressure_ratio = scene.earth_pressure_ratio,
          .viscosity = n.viscosity,
          .flow_viscosity = n.flow_viscosity,
          .stress_diffusion = n.stress_diffusion};
}

} // namespace host
