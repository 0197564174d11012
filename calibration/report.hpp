// SPDX-License-Identifier: BSD-3-Clause
// The result of a fit as text, TOML, HDF5 and a material file.
#pragma once
#include "calibration/posterior.hpp"
#include <filesystem>
#include <optional>

namespace calibration {

struct Result {
  const Objective& objective;
  const BestFit& fit;
  const Identifiability& identifiability;
  const Posterior* posterior = nullptr; ///< null: none was sampled
  std::string command;                  ///< command line of the fit
  double seconds = 0;
};

/// Misfit of one curve.
struct CurveMisfit {
  double rms = 0;       ///< root mean square in the unit of the curve, rows weighted by arc length
  double of_peak = 0;   ///< the same over the largest magnitude of the curve
  double in_errors = 0; ///< root mean square of the residuals in standard deviations
};
std::vector<CurveMisfit> misfits(const Objective& objective, const Eigen::VectorXd& u);
/// Coordinates of the parameters of the material file, with the model errors of the best fit.
Eigen::VectorXd at_material(const Result& result);

/// Reasons not to trust the parameters, one line each.
std::vector<std::string> warnings(const Result& result);

std::string report_text(const Result& result);
std::string report_toml(const Result& result);
/// A material file for `simsand run` and `simsand element`.
std::string material_toml(const Result& result);
void write_hdf5(const Result& result, const std::filesystem::path& file);

/// All files, in the folder of the fit. Returns their paths.
std::vector<std::string> write_report(const Result& result);

} // namespace calibration
