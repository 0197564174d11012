// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a chain file, an HDF5 file with a checksum over all of it. Layout: calibration/SAMPLER.md.
#pragma once
#include "calibration/sampler_state.hpp"
#include <string>

namespace calibration {

inline constexpr const char* chain_format_name = "simsand chain";
inline constexpr int chain_format_version = 2;

/// The file as it shall stand on disk, built in memory. Throws H5::Exception.
std::string chain_image(const SamplerState& state, const SamplerOptions& options,
                        const Checkpoint& checkpoint);

} // namespace calibration
