// SPDX-License-Identifier: BSD-3-Clause
// States on the way of laboratory tests and the strain increments that lead on from there.
#pragma once
#include "tests/charts/sand.hpp"
#include <string>

namespace charts {

struct Case {
  int sand;                   ///< position in `sands`
  std::string path, density;  ///< names in tables
  double pressure, increment; ///< Pa; sqrt(d eps : d eps)
  Point start;                ///< on the yield surface or inside
  std::vector<Tensor> strain; ///< increments, one after the other
};

/// What to combine. Every path at every density, pressure, stage and sand.
struct CaseChoice {
  std::vector<double> pressures{1, 30, 1e3, 3e4, 1e6};
  std::vector<double> stages{0, 0.5, 0.9, 0.99}; ///< share of the strength that is mobilised at the start
  int increments = 10;                           ///< at most; their sum is at most 0.1
};

inline const std::vector<std::string> path_names{"drained compression",
                                                 "drained extension",
                                                 "undrained compression",
                                                 "true triaxial",
                                                 "simple shear, constant volume",
                                                 "simple shear, constant normal stress",
                                                 "random"};
inline const std::vector<std::string> density_names{"dense", "loose", "very loose"};

/// The cases for increments of one size. Tests with stress control take the direction of strain that holds that stress
/// at the start.
std::vector<Case> laboratory_cases(const CaseChoice& choice, double increment);

/// Updates sampled from a run by `chart increments`: a table with the columns named in increments.hpp. Each starts
/// where the product's update without strain puts it, so that none is outside of the yield surface. Throws
/// std::runtime_error that names file and line.
std::vector<Case> sampled_cases(const std::string& file, std::vector<double>& props);

} // namespace charts
