// SPDX-License-Identifier: BSD-3-Clause
// A fit: tests, unknowns, errors and options, read from FIT.toml and checked. Manual: README.md.
#pragma once
#include "calibration/free_parameters.hpp"
#include "calibration/lab_test.hpp"
#include "drivers/files/material_file.hpp"
#include <array>
#include <cstdint>
#include <optional>

namespace calibration {

/// Standard deviations of the values of one measure, and the weight of its curves.
struct ErrorModel {
  bool declared = false;
  double absolute = 0;              ///< in the unit of the curve, SI
  double relative = 0, of_peak = 0; ///< over the value; over the largest magnitude of the curve
  double model = 0;                 ///< error of the model, over the largest magnitude
  int free_model = -1;              ///< position among the unknowns of the model's error; -1: it is given
  double weight = 1;
};

enum class Weighting { arc, strain, rows };

struct SearchOptions {
  int starts = 8, candidates = 8; ///< number of searches; points evaluated for the choice of each start
  int iterations = 100;           ///< limit of one search
  std::uint64_t seed = 1;
};

struct SamplingOptions {
  int walkers = 32, burn_in = 400, steps = 1600, thinning = 1;
  std::uint64_t seed = 1;
  int predictive_sets = 400;                        ///< samples drawn for the predicted bands
  int coverage_burn_in = 200, coverage_steps = 300; ///< for each data set of a coverage study
};

/// Tests whose curves are made from known parameters.
struct Synthetic {
  std::vector<double> properties; ///< PROPS
  double noise = 0;               ///< in standard deviations of the measurement
  std::uint64_t seed = 1;
};

struct Fit {
  std::string title, file_name;
  drivers::LoadedMaterial
      material; ///< gives the fixed parameters; the report compares its parameters with the result
  std::string material_source; ///< path of the material file
  double grain_density = 0;
  std::vector<FreeParameter> unknowns;
  std::vector<LabTest> tests;
  std::array<ErrorModel, measures.size()> errors;
  Weighting weighting = Weighting::arc;
  bool estimate_correlation = true;
  std::optional<Synthetic> synthetic;
  SearchOptions search;
  std::optional<SamplingOptions> sampling;
  std::string output_folder, material_name;
  std::string resolved; ///< the file with every default written out

  int parameters() const; ///< unknowns that belong to the material; they come first
};

/// Throws std::runtime_error naming file, line and key. Curves of synthetic tests are made here.
Fit read_fit(const std::string& path);

/// Computes the curves of all tests at the parameters of `synthetic` and adds noise. `seed` is that of the noise.
void make_curves(Fit& fit, std::uint64_t seed);

} // namespace calibration
