// SPDX-License-Identifier: BSD-3-Clause
// Response envelopes (Gudehus 1979): the stress answers of one state to strain increments of equal length in
// all directions of the Rendulic plane, whose axes are axial and sqrt(2) times radial.
#pragma once
#include "drivers/element/condition.hpp"
#include "drivers/files/toml_table.hpp"
#include <functional>

namespace drivers {

struct Envelope {
  double strain_norm = 0; ///< sqrt(d eps : d eps)
  long directions = 72;   ///< equally spaced
  long increments = 1;    ///< of each direction
};

Envelope read_envelope(const TomlTable& table);

/// One probe. The angle counts from the radial axis towards the axial one: 35.26 degrees is isotropic
/// compression, 215.26 isotropic extension.
struct EnvelopeRow {
  int stage;
  double angle; ///< degrees
  Vector6 strain_increment, stress, stress_change;
};
using EnvelopeSink = std::function<void(const EnvelopeRow&)>;

/// Probes all directions from `state`, which is not changed; `duration` in s. Throws std::runtime_error naming the
/// direction, stress and strain increment, if an answer is not usable; `failed_point` as in StageSetting.
void probe(MaterialCaller& material, const PointState& state, const Envelope& envelope, double duration,
           int stage, const EnvelopeSink& sink, const std::string& failed_point = {});

} // namespace drivers
