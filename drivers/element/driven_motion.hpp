// SPDX-License-Identifier: BSD-3-Clause
// A stage that is driven by the motion itself, rotation included: a deformation gradient to be reached, or a velocity
// gradient. Base axes, tension positive.
#pragma once
#include "drivers/element/material_point.hpp"
#include "drivers/files/toml_table.hpp"

namespace drivers {

/// `control` of such a stage.
inline constexpr const char* motion_control = "deformation-gradient";

struct DrivenMotion {
  bool by_velocity = false;
  /// F at the end of the stage, reached in a straight line; or the velocity gradient times the duration, which
  /// is constant. A row is a component of position or velocity, a column a direction.
  host::Tensor value = host::Tensor::Identity();
  std::string where; ///< FILE:LINE
};

/// Reads `gradient` or `velocity_gradient`: nine numbers, row by row.
DrivenMotion read_motion(const TomlTable& table);

/// Takes `point` from one fraction of a stage to another; `at_start` is F where the stage began. After an answer that is
/// not finite, or a failure reported by the material, `point` is unchanged. Throws std::runtime_error for a motion
/// that cannot be followed: det F not above 0, or a rotation or strain too large for one increment.
StepReport follow(MaterialCaller& material, const DrivenMotion& motion, const host::Tensor& at_start,
                  double from, double to, double duration, PointState& point);

} // namespace drivers
