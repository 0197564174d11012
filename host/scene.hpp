// SPDX-License-Identifier: BSD-3-Clause
// What is to be simulated, in SI units: everything a run needs and nothing it computes.
#pragma once
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

/// What part of a cylinder is simulated in three dimensions: all of it, x >= 0, or x >= 0 and y >= 0.
enum class Sector { full, half, quarter };

/// Number of vertical planes of symmetry: x = 0, then y = 0.
inline int symmetry_planes(Sector sector) {
  return sector == Sector::full ? 0 : (sector == Sector::half ? 1 : 2);
}

/// Part of the whole cylinder.
inline double fraction(Sector sector) {
  return 1.0 / (1 << symmetry_planes(sector));
}

/// A column of radius (plane strain: half width) `radius` that stands on the floor at height 0,
/// symmetric about the axis at coordinate 0.
struct Column {
  double radius = 0;     ///< m
  double height = 0;     ///< m
  bool symmetric = true; ///< plane strain: the half x >= 0 is simulated; false: all of it
  double depth =
      0; ///< m, half width along y of a cuboid in three dimensions, `radius` along x; 0: a cylinder
  std::array<double, 2> center{}; ///< m, horizontal place of the middle of its base
  double base = 0;                ///< m, height of the middle of its base
  double tilt = 0;                ///< degrees, turned about that point from x towards z
  bool placed() const { return center[0] != 0 || center[1] != 0 || base != 0 || tilt != 0; }
};

struct Floor {
  bool present = true;
  bool no_slip = false;
  double friction = 0; ///< Coulomb coefficient where slip is allowed
};

enum class GateMotion { fixed, lift, remove };

/// Rigid, frictionless retaining wall at coordinate `Column::radius`; in three dimensions a cylinder.
struct Gate {
  GateMotion motion = GateMotion::lift;
  double speed = 0; ///< m/s, upwards
  /// Height of its lower edge, m. A gate that has not moved reaches below the floor.
  double lower_edge(double time) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    if (motion == GateMotion::remove) return far;
    return motion == GateMotion::fixed ? -far : speed * time;
  }
};

/// Numerical choices; their effect is measured, the defaults are the recommended ones.
struct Numerics {
  KernelKind kernel = KernelKind::wendland_c2;
  double smoothing_length = 1.5;      ///< in spacings
  double viscosity = 0.05;            ///< alpha of the artificial viscosity: times the wave speed
  double flow_viscosity = 25;         ///< beta: times smoothing length and velocity gradient
  double stress_diffusion = 5;        ///< in smoothing lengths squared per unit strain
  double step_factor = 0.4;           ///< step = factor * h / (wave speed + flow speed)
  double wave_speed_tolerance = 0.02; ///< change of stress up to which a wave speed is kept, relative
  double skin = 0.4;                  ///< of the neighbour lists, in spacings
};

struct Scene {
  GeometryKind geometry = GeometryKind::axisymmetric;
  Sector sector = Sector::full; ///< of a three-dimensional column
  double spacing = 0;           ///< m, initial distance of particles
  double gravity = 0;           ///< m/s2
  Column column;
  Material material;
  std::vector<std::string> state_names; ///< one for each state variable
  std::vector<double> initial_state;    ///< STATEV of every particle at the start
  int failure_state = -1;  ///< position in STATEV that is negative after a failed update; -1: there is none
  double bulk_density = 0; ///< kg/m3, initial
  double earth_pressure_ratio = 0; ///< K0: horizontal over vertical initial stress
  double friction_angle = 0;       ///< degrees, critical state; 0 where the material has none
  Floor floor;
  Gate gate;
  std::vector<Wall> walls; ///< beside floor and gate
  Numerics numerics;
  double end_time = 0;        ///< s
  double rest_fraction = 0;   ///< at rest when kinetic energy / initial potential energy is below it
  double sample_interval = 0; ///< s
  double snapshot_interval = 0;
  double checkpoint_interval = 60; ///< s of wall clock
  double grain_diameter = 0;       ///< m: the front is where the deposit is this high
  std::string output_folder;
  std::string resolved; ///< the scene file with every key written out
};

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
