// SPDX-License-Identifier: BSD-3-Clause
// `simsand-chart stability`: where the particle scheme holds and where it does not, over its numerical choices.
#pragma once
#include "host/scene.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace charts {

/// One run: a column of radius and height 50 mm whose wall is taken away at once.
struct StabilityCase {
  std::string material;          ///< "simsand" (TS, dense) or "elastic" (1 MPa, 0.3)
  host::GeometryKind geometry{}; ///< plane strain or axisymmetric
  int particles_per_radius = 10;
  double smoothing_length = 1.5; ///< spacings
  double viscosity = 1;          ///< times both coefficients of the recommended one
  double stress_diffusion = 5;   ///< smoothing lengths squared per unit strain
  double step_factor = 0.4;
};

/// What came of it. Energies over the initial potential energy.
struct StabilityOutcome {
  int particles = 0;
  long steps = 0;
  double end_time = 0;     ///< s
  std::string ended;       ///< "end", or which guard stopped it: "strain", "step", "energy", "material"
  double imbalance = 0;    ///< largest error of the energy balance
  double made = 0;         ///< largest energy beyond that of the start
  double kinetic_peak = 0; ///< largest of all times,
  double kinetic_start = 0, kinetic_end = 0; ///< of the first tenth and of the last
  double thrown = 0; ///< share of the particles that ever had more than 1.05 g h0 of energy per mass
  double noise = 0;  ///< checkerboard index, mean over the time in which the column falls
  double height = 0, front = 0; ///< of the deposit at the end, r0
  std::string verdict;          ///< "holds", or the first criterion that is not met
};

/// Bounds of the verdict, beyond the guards of a run (host/engine/guard.hpp): particles thrown off; kinetic energy of the sand
/// in the last tenth, when it should be at rest. The elastic column, which only trembles, must not move more in the last
/// tenth than in the first.
inline constexpr double most_thrown = 0.01, most_kinetic_end = 0.01;

/// Runs it on one thread; a scheme that fails is an outcome, not an error.
StabilityOutcome run_stability_case(const StabilityCase& c);

struct StabilityOptions {
  std::filesystem::path folder = "results/chart";
  bool quick = false;  ///< a small grid
  bool afresh = false; ///< forget an earlier part
};

std::vector<StabilityCase> stability_grid(bool quick);

/// Runs what the table in the folder does not hold yet, each row written as it is known, and prints a summary.
/// Throws std::runtime_error, for one if the table is of another kind.
void chart_stability(const StabilityOptions& options);

inline constexpr const char* stability_header =
    "material,geometry,particles_per_radius,smoothing_length,viscosity,stress_diffusion,step_factor,"
    "particles,steps,end_time_s,ended,energy_imbalance,energy_made,kinetic_peak,kinetic_start,kinetic_end,"
    "thrown,noise,height,front,"
    "verdict";

} // namespace charts
