// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/driven_motion.hpp"
#include <Eigen/LU>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>

namespace drivers {
namespace {

host::Kinematics motion_to(const DrivenMotion& motion, const host::Tensor& at_start, double from, double to,
                           const host::Tensor& now) {
  if (motion.by_velocity) return host::motion_by_gradient(now, (to - from) * motion.value);
  const host::Tensor target = at_start + to * (motion.value - at_start);
  if (!(target.determinant() > 0))
    throw std::runtime_error(
        fmt::format("the straight line to the deformation gradient passes through a determinant of {:g}",
                    target.determinant()));
  return host::motion_between(now, target);
}

} // namespace

DrivenMotion read_motion(const TomlTable& table) {
  DrivenMotion motion;
  motion.by_velocity = table.has("velocity_gradient");
  if (motion.by_velocity && table.has("gradient"))
    table.fail("gradient", "only one of gradient, velocity_gradient", "both");
  const auto* key = motion.by_velocity ? "velocity_gradient" : "gradient";
  const auto rows = table.numbers(key, 9);
  motion.value = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  if (!motion.by_velocity && !(motion.value.determinant() > 0))
    table.fail(key, "a deformation gradient of positive determinant",
               fmt::format("one of {:g}", motion.value.determinant()));
  motion.where = table.where(key);
  return motion;
}

StepReport follow(MaterialCaller& material, const DrivenMotion& motion, const host::Tensor& at_start,
                  double from, double to, double duration, PointState& point) {
  std::optional<host::Kinematics> kinematics;
  try {
    kinematics = motion_to(motion, at_start, from, to, point.gradient);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", motion.where, error.what()));
  }
  auto answer = material.follow(point, *kinematics, (to - from) * duration);
  StepReport report;
  report.finite = is_finite(answer);
  report.refused = material.refused(answer);
  report.converged = report.finite && !report.refused;
  if (report.converged) point = std::move(answer);
  return report;
}

} // namespace drivers
