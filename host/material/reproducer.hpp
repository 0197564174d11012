// SPDX-License-Identifier: BSD-3-Clause
// Evidence of a failed call: the inputs of one point, and a file with these that `simsand element` replays.
#pragma once
#include "host/material/block.hpp"
#include <filesystem>

namespace host {

/// All inputs of one point, in the components of the call.
struct PointCall {
  Increment increment;
  VumatBlock block; ///< of one point
};

/// The inputs of point k of a block.
PointCall point_call(const Material& material, const Increment& increment, const VumatBlock& block, int k);

/// Index in the block of the first point whose results are not finite or whose material reports a failure; -1 if
/// there is none. `failure_state`: position in STATEV that is negative after a failed update, -1: none.
int first_failure(const VumatBlock& block, int failure_state);

/// Why the results of point k cannot be used; empty if they can.
std::string fault_of(const VumatBlock& block, int k, int failure_state);

/// Results that cannot be used: why, and the inputs of the call.
struct BadAnswer {
  std::string fault;
  PointCall call;
};

/// The path file. `remark` becomes its first line.
std::string reproducer_text(const Material& material, int failure_state, const PointCall& call,
                            const std::string& remark);

/// One line about a failed call: material, fault, `who` (may be empty), time, as many coordinates as `dimension` says,
/// stress and strain increment. Writes the reproducer to `file`, unless that is empty, and adds how to replay it.
std::string evidence_of(const Material& material, int failure_state, const BadAnswer& bad,
                        const std::string& who, int dimension, const std::filesystem::path& file);

} // namespace host
