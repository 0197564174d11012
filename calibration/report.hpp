// SPDX-License-Identifier: BSD-3-Clause
// What a fit found, in text, TOML, HDF5 and as a material file.
#pragma once
#include "calibration/posterior.hpp"
#include <filesystem>
#include <optional>

namespace calibration {

struct Result {
  const Objective& objective;
  const BestFit& fit;
  const Identifiability& known;
  const Posterior* posterior = nullptr; ///< null: none was sampled
  std::string command;                  ///< that made it
  double seconds = 0;
};

/// How one curve is met.
struct CurveMisfit {
  double rms = 0;       ///< in the unit of the curve, weighed by arc
  double of_peak = 0;   ///< the same over the largest magnitude
  double in_errors = 0; ///< rms of the residuals in standard deviations
};
std::vector<CurveMisfit> misfits(const Objective& objective, const Eigen::VectorXd& u);
/// The best fit with the parameters of the material file in place of those found.
Eigen::VectorXd at_material(const Result& result);

/// All that should keep a reader from trusting the numbers, one line each; empty: nothing.
std::vector<std::string> warnings(const Result& result);

std::string report_text(const Result& result);
std::string report_toml(const Result& result);
/// A material file for `simsand run` and `simsand element`.
std::string material_toml(const Result& result);
void write_hdf5(const Result& result, const std::filesystem::path& file);

/// All files, in the folder of the fit. Returns their paths.
std::vector<std::string> write_report(const Result& result);

} // namespace calibration
