// SPDX-License-Identifier: BSD-3-Clause
// `chart increments`: the strain increments that a run gives to its material, and from what states.
#pragma once
#include <string>

namespace charts {

struct IncrementOptions {
  std::string scene, folder = "results/increments";
  int samples = 4096;  ///< updates kept for `chart element --states`
  double end_time = 0; ///< s, instead of the scene's; 0: the scene's, or rest
};

/// Runs the scene and writes
///   increments.csv  counts by phase, strain sqrt(d eps : d eps) and mean stress before the update, Pa; one column for
///                   each answer: elastic, plastic, stress_free, substepped;
///   states.csv      updates of the collapse, all equally likely to be kept: compression positive, Pa;
///   increments.toml shares and percentiles.
/// The phases are the collapse, up to 3 sqrt(h0 / g), and what follows. Results do not depend on the number of threads.
/// Throws std::runtime_error; the material must be SIMSAND of this build.
void chart_increments(const IncrementOptions& options);

inline constexpr const char* increments_header =
    "phase,strain_from,strain_to,pressure_from_Pa,pressure_to_Pa,elastic,"
    "plastic,stress_free,substepped";
inline constexpr const char* states_header =
    "strain_11,strain_22,strain_33,strain_12,stress_11,stress_22,stress_33,"
    "stress_12,void_ratio,plastic_deviatoric_strain,separation_strain";

} // namespace charts
