// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/material_point.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drivers {
namespace {

/// Size of a stress, Pa: p where it is isotropic.
double stress_level(const Vector6& stress) {
  return stress.head<3>().norm() / std::sqrt(3.0);
}

/// A strain increment tried from a converged state, the answer to it, and how far the restrictions
/// are from being met.
struct Trial {
  Vector6 increment;
  PointState answer;
  Vector6 residual; ///< each in its own unit
  Vector6 scaled;   ///< residual over what the tolerance allows
  double error;     ///< largest of `scaled`; infinite if the material failed
};

/// Newton's method for one increment from `start` to the restrictions at `fraction`.
struct Increment {
  MaterialCaller& material;
  const MixedControl& control;
  const NewtonOptions& options;
  const PointState& start;
  double fraction, dt;
  StageScale scale;
  Matrix6& stiffness;
  StepReport& report;

  /// Stress error, Pa, that the tolerance allows.
  double allowed_stress(const Vector6& stress) const {
    return options.tolerance * std::max(stress_level(stress), options.lowest_level * scale.stress);
  }

  /// What one unit of the scaled residual is, per restriction. A strain may be off by what changes stress by
  /// the allowed error, and by round-off.
  Vector6 allowed(const PointState& at) const {
    const double stress = allowed_stress(at.stress);
    const double strain = stress / scale.modulus + 1e-15 * (1 + at.strain.cwiseAbs().maxCoeff());
    return stress * control.stress.cwiseAbs().rowwise().maxCoeff() +
           strain * control.strain.cwiseAbs().rowwise().maxCoeff();
  }

  Trial judged(const Vector6& increment, PointState answer) const {
    Trial t{increment, std::move(answer), {}, {}, std::numeric_limits<double>::infinity()};
    const bool finite = is_finite(t.answer);
    t.residual = control.stress * t.answer.stress + control.strain * t.answer.strain - control.at_start -
                 fraction * control.change;
    t.scaled = t.residual.cwiseQuotient(allowed(finite ? t.answer : start));
    if (finite && t.scaled.allFinite() && !material.refused(t.answer))
      t.error = t.scaled.cwiseAbs().maxCoeff();
    return t;
  }

  Trial tried(const Vector6& increment) const {
    return judged(increment, material.respond({&start, 1}, {&increment, 1}, dt).front());
  }

  /// Correction that a linear material of the present stiffness would need. One that starts without stress
  /// and stiffness (liquefied, parted) is given some, so that the restrictions on strain still decide.
  Vector6 correction(const Trial& from) const {
    const Vector6 weight = allowed(from.answer).cwiseInverse();
    const bool lost = stiffness.cwiseAbs().maxCoeff() < 1e-9 * scale.modulus &&
                      stress_level(start.stress) <= options.lowest_level * scale.stress;
    const Matrix6 used = lost ? Matrix6(scale.modulus * Matrix6::Identity()) : stiffness;
    const Matrix6 system = weight.asDiagonal() * (control.stress * used + control.strain);
    return -system.partialPivLu().solve(weight.cwiseProduct(from.residual));
  }

  /// Broyden's update: the stiffness that explains the step from one trial to the next. A step that moves
  /// stress by no more than round-off (an increment at rest) teaches nothing.
  void learn(const Trial& from, const Trial& to) const {
    const Vector6 step = to.increment - from.increment;
    if (!(step.norm() * scale.modulus > allowed_stress(to.answer.stress))) return;
    const Vector6 surprise = to.answer.stress - from.answer.stress - stiffness * step;
    stiffness += surprise * step.transpose() / step.squaredNorm();
  }

  /// Central differences about a trial, twelve perturbed increments in one block. One-sided ones would
  /// see a slope at the kink of dilatancy on the isotropic axis. The perturbation is as large as the
  /// correction that is due, so that it sees the branch (elastic or plastic) the correction will meet.
  bool differentiate(const Trial& at) const {
    const double due = correction(at).cwiseAbs().maxCoeff(),
                 largest = 1e-3 * at.increment.cwiseAbs().maxCoeff();
    const double least = 10 * allowed_stress(at.answer.stress) / scale.modulus; // above round-off
    const double h = std::max(std::isfinite(due) ? std::min(due, largest) : largest, least);
    std::array<Vector6, 12> increments;
    for (int c = 0; c < 12; ++c) increments[c] = at.increment + (c < 6 ? h : -h) * Vector6::Unit(c % 6);
    const auto answers = material.respond({&start, 1}, increments, dt);
    Matrix6 result;
    for (int c = 0; c < 6; ++c) result.col(c) = (answers[c].stress - answers[c + 6].stress) / (2 * h);
    if (result.allFinite()) stiffness = result;
    return result.allFinite();
  }

  /// Halves `step` until the error falls (or, for the first step, until the answer is finite).
  bool advanced(Trial& current, Vector6 step, bool first, int halvings) const {
    for (double share = 1; halvings-- >= 0; share *= 0.5, step *= 0.5) {
      if (!step.allFinite()) { // the stiffness is not, or the conditions are dependent
        note(tried(current.increment));
        return false;
      }
      auto next = tried(current.increment + step);
      const bool better =
          std::isfinite(next.error) && (first || next.error < (1 - 0.1 * share) * current.error);
      if (better || halvings < 0) note(next);
      if (!better) continue;
      learn(current, next);
      current = std::move(next);
      return true;
    }
    return false;
  }

  void note(const Trial& t) const {
    report.finite = is_finite(t.answer);
    report.refused = material.refused(t.answer);
    t.scaled.cwiseAbs().maxCoeff(&report.restriction);
    report.residual = t.residual[report.restriction];
  }

  /// The state at the end of the increment; the committed state and false after a failure.
  std::pair<PointState, bool> solved() const {
    Trial current = judged(Vector6::Zero(), start);
    bool fresh = false; // whether the stiffness was differentiated at `current`
    for (int i = 0; i < options.max_iterations; ++i, ++report.iterations) {
      if (i > 0 && current.error <= 1) return {std::move(current.answer), true};
      const double before = current.error;
      const bool first = i == 0;
      if (!advanced(current, correction(current), first, fresh || first ? 6 : 0)) {
        if (fresh || first || !differentiate(current)) return {start, false};
        fresh = true;
        continue;
      }
      fresh = current.error > 1 && !first && current.error > 0.1 * before && differentiate(current);
    }
    return {start, false};
  }
};

} // namespace

StageScale scale_of(const Vector6& stress, const Matrix6& stiffness) {
  return {stress_level(stress), stiffness.cwiseAbs().maxCoeff()};
}

StepReport advance(MaterialCaller& material, const MixedControl& control, double from, double to,
                   double duration, const StageScale& scale, const NewtonOptions& options, PointState& point,
                   Matrix6& stiffness) {
  StepReport report;
  const double smallest = (to - from) * std::ldexp(1.0, -options.max_cuts);
  double step = to - from;
  for (double at = from; at < to;) {
    const bool last = at + step >= to;
    const double target = last ? to : at + step;
    const Increment increment{material, control,   options, point, target, (target - at) * duration,
                              scale,    stiffness, report};
    auto [answer, converged] = increment.solved();
    if (converged) {
      point = std::move(answer);
      at = target;
      step *= 2; // back towards the whole increment
      continue;
    }
    report.fraction = target;
    if (step / 2 < smallest) {
      report.converged = false;
      if (report.finite && !report.refused) { // what is missing of the whole increment, not of its last part
        const Increment whole{material, control,   options, point, to, (to - at) * duration,
                              scale,    stiffness, report};
        whole.note(whole.judged(Vector6::Zero(), point));
      }
      return report;
    }
    ++report.cuts;
    step /= 2;
    if (const auto elastic = material.elastic_stiffness(point); elastic.allFinite()) stiffness = elastic;
  }
  return report;
}

} // namespace drivers
