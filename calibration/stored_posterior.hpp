// SPDX-License-Identifier: BSD-3-Clause
// The posterior in a result of `simsand calibrate` (fit.h5), as a scene needs it.
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
  std::map<std::string, double> fixed; ///< the other keys of SIMSAND, that the samples are conditional on
  bool converged = false;              ///< by the diagnosis of the fit
};

/// Sizes of the model's error, which are sampled along, are left out. Throws std::runtime_error naming the file: no
/// result of a fit, no posterior in it, a chain (which holds coordinates, not values).
StoredPosterior read_posterior(const std::filesystem::path& file);

/// Throws std::runtime_error naming file and key unless the scene's material is SIMSAND, all that was sampled are keys of
/// it, and what was fixed in the fit has the same value in the scene.
void require_fit_for(const host::Scene& scene, const StoredPosterior& posterior);

/// `count` different rows, drawn at random. Throws std::runtime_error if there are fewer.
std::vector<std::size_t> draw_rows(const StoredPosterior& posterior, int count, std::uint64_t seed);

} // namespace calibration
