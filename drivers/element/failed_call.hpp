// SPDX-License-Identifier: BSD-3-Clause
// Repeats one call of a subroutine from the path file with a table `[call]` that a run writes when a material fails
// (host/material/reproducer.hpp). Names, components and signs are those of the interface, not of other path files.
#pragma once
#include "drivers/files/material_file.hpp"
#include "host/material/reproducer.hpp"

namespace drivers {

/// A call, read.
struct FailedCall {
  LoadedMaterial material;
  host::PointCall call;
};

/// Throws std::runtime_error with FILE:LINE.
FailedCall read_failed_call(const TomlTable& document);

/// Makes the call and returns its answer as a table (.csv): quantity, component, old, new. `fault` says why
/// the answer cannot be used; empty if it can. Throws as host::call_vumat.
std::string repeat_call(FailedCall& failed, std::string& fault);

} // namespace drivers
