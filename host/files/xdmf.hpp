// SPDX-License-Identifier: BSD-3-Clause
// The XDMF side file with which ParaView opens the snapshots of a result file.
#pragma once
#include "host/files/output.hpp"

namespace host {

/// One time of the ParaView collection: `group` of the HDF5 file `file`, which lies beside.
std::string xdmf_grid(const std::string& file, const std::string& group, double time, std::size_t particles,
                      std::span<const Field> fields);

/// Writes the collection of `grids`. Throws std::runtime_error naming the file.
void write_xdmf(const std::filesystem::path& to, const std::string& grids);

/// The grids without the one that reads from `group`.
std::string without_xdmf_grid(std::string grids, const std::string& group);

} // namespace host
