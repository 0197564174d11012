// SPDX-License-Identifier: BSD-3-Clause
// The posterior in a result of `simsand calibrate` (fit.h5), for runs of a scene.
#pragma once
#include "drivers/files/toml_text.hpp"
#include "host/scene.hpp"
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace calibration {

struct StoredPosterior {
  std::filesystem::path file;
  drivers::Words names;                     ///< keys of the material that were sampled
  std::vector<std::vector<double>> samples; ///< values, one row a sample
  std::map<std::string, double> fixed;      ///< values of SIMSAND's other keys in the fit
  bool converged = false;                   ///< by the diagnosis of the fit
};

/// Reads the samples without the model errors. Throws std::runtime_error naming the file if it is no result of a fit, has
/// no posterior, or is a chain (which holds coordinates, not values).
StoredPosterior read_posterior(const std::filesystem::path& file);

/// Throws std::runtime_error naming file and key unless the scene's material is SIMSAND, all sampled parameters are keys of
/// it, and parameters that were fixed in the fit have the same value in the scene.
void require_fit_for(const host::Scene& scene, const StoredPosterior& posterior);

/// `count` different rows, drawn at random. Throws std::runtime_error if there are fewer.
std::vector<std::size_t> draw_rows(const StoredPosterior& posterior, int count, std::uint64_t seed);

} // namespace calibration
