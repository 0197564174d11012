// SPDX-License-Identifier: BSD-3-Clause
// One point of one call, as evidence of a failure: a path file that `simsand element` replays.
#pragma once
#include "host/vumat_block.hpp"

namespace host {

/// All inputs of one point, in the components of the call.
struct PointCall {
  Increment increment;
  VumatBlock block; ///< of one point
};

/// Point k of a block, as it was called.
PointCall point_call(const Material& material, const Increment& increment, const VumatBlock& block, int k);

/// Why an answer cannot be used; empty if it can. `failure_state`: position in STATEV that is negative after a
/// failed update, -1: none.
std::string fault_of(const VumatBlock& block, int k, int failure_state);

/// The path file. `remark` becomes its first line.
std::string reproducer_text(const Material& material, int failure_state, const PointCall& call,
                            const std::string& remark);

/// Writes `text` to failed_point.toml in the job's folder and returns " (replay: simsand element FILE)"; what is to
/// be said instead if it cannot be written, and nothing without a folder.
std::string write_reproducer(const std::string& text);

} // namespace host
