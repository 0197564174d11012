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

/// A strain increment from a converged state, the material's answer to it, and the residual of the conditions.
struct TrialIncrement {
  Vector6 increment;
  PointState answer;
  Vector6 residual; ///< each in its own unit
  Vector6 scaled;   ///< residual over its tolerance
  double error;     ///< largest of `scaled`; infinite if the material failed
};

/// Newton's method for one increment, from `start` to the conditions at `fraction`.
struct NewtonSolve {
  MaterialCaller& material;
  const MixedControl& control;
  const NewtonOptions& options;
  const PointState& start;
  double fraction, dt;
  StageScale scale;
  Matrix6& stiffness;
  StepReport& report;

  /// Tolerance of a stress, Pa.
  double stress_tolerance(const Vector6& stress) const {
    return options.tolerance * std::max(stress_level(stress), options.lowest_level * scale.stress);
  }

  /// Tolerance of each condition, in its own unit. That of a strain is the strain that changes stress by the tolerance
  /// of stress, plus round-off.
  Vector6 tolerances(const PointState& at) const {
    const double stress = stress_tolerance(at.stress);
    const double strain = stress / scale.modulus + 1e-15 * (1 + at.strain.cwiseAbs().maxCoeff());
    return stress * control.stress.cwiseAbs().rowwise().maxCoeff() +
           strain * control.strain.cwiseAbs().rowwise().maxCoeff();
  }

  TrialIncrement evaluated(const Vector6& increment, PointState answer) const {
    TrialIncrement t{increment, std::move(answer), {}, {}, std::numeric_limits<double>::infinity()};
    const bool finite = is_finite(t.answer);
    t.residual = control.stress * t.answer.stress + control.strain * t.answer.strain - control.at_start -
                 fraction * control.change;
    t.scaled = t.residual.cwiseQuotient(tolerances(finite ? t.answer : start));
    if (finite && t.scaled.allFinite() && !material.refused(t.answer))
      t.error = t.scaled.cwiseAbs().maxCoeff();
    return t;
  }

  TrialIncrement trial(const Vector6& increment) const {
    return evaluated(increment, material.respond({&start, 1}, {&increment, 1}, dt).front());
  }

  /// Correction of the strain increment that a linear material of the present stiffness needs. A material that starts
  /// without stress and stiffness (liquefied, separated) is replaced by an elastic one: otherwise the system would be
  /// singular, although the conditions on strain determine the increment.
  Vector6 correction(const TrialIncrement& from) const {
    const Vector6 weight = tolerances(from.answer).cwiseInverse();
    const bool no_stiffness = stiffness.cwiseAbs().maxCoeff() < 1e-9 * scale.modulus &&
                              stress_level(start.stress) <= options.lowest_level * scale.stress;
    const Matrix6 used = no_stiffness ? Matrix6(scale.modulus * Matrix6::Identity()) : stiffness;
    const Matrix6 system = weight.asDiagonal() * (control.stress * used + control.strain);
    return -system.partialPivLu().solve(weight.cwiseProduct(from.residual));
  }

  /// Broyden's update: the stiffness that explains the change of stress from one trial to the next. Steps that change
  /// stress by no more than its tolerance are left out, as round-off decides their answer.
  void update_stiffness(const TrialIncrement& from, const TrialIncrement& to) const {
    const Vector6 step = to.increment - from.increment;
    if (!(step.norm() * scale.modulus > stress_tolerance(to.answer.stress))) return;
    const Vector6 unexplained = to.answer.stress - from.answer.stress - stiffness * step;
    stiffness += unexplained * step.transpose() / step.squaredNorm();
  }

  /// Stiffness by central differences about a trial: twelve perturbed increments in one block. One-sided differences
  /// would be wrong on the isotropic axis, where the dilatancy has a kink. The perturbation is as large as the next
  /// correction, so that both meet the same branch, elastic or plastic. False: the differences are not finite.
  bool differentiate(const TrialIncrement& at) const {
    const double next = correction(at).cwiseAbs().maxCoeff(),
                 largest = 1e-3 * at.increment.cwiseAbs().maxCoeff();
    const double least = 10 * stress_tolerance(at.answer.stress) / scale.modulus; // above round-off
    const double h = std::max(std::isfinite(next) ? std::min(next, largest) : largest, least);
    std::array<Vector6, 12> increments;
    for (int c = 0; c < 12; ++c) increments[c] = at.increment + (c < 6 ? h : -h) * Vector6::Unit(c % 6);
    const auto answers = material.respond({&start, 1}, increments, dt);
    Matrix6 result;
    for (int c = 0; c < 6; ++c) result.col(c) = (answers[c].stress - answers[c + 6].stress) / (2 * h);
    if (result.allFinite()) stiffness = result;
    return result.allFinite();
  }

  /// Line search: halves `step` until the error decreases or, in the first step, until the answer is finite. False: it
  /// did not within `halvings`.
  bool take_step(TrialIncrement& current, Vector6 step, bool first, int halvings) const {
    for (double share = 1; halvings-- >= 0; share *= 0.5, step *= 0.5) {
      if (!step.allFinite()) { // the stiffness is not finite, or the conditions are dependent
        record(trial(current.increment));
        return false;
      }
      auto next = trial(current.increment + step);
      const bool better =
          std::isfinite(next.error) && (first || next.error < (1 - 0.1 * share) * current.error);
      if (better || halvings < 0) record(next);
      if (!better) continue;
      update_stiffness(current, next);
      current = std::move(next);
      return true;
    }
    return false;
  }

  /// Keeps what the report says of a failure.
  void record(const TrialIncrement& t) const {
    report.finite = is_finite(t.answer);
    report.refused = material.refused(t.answer);
    t.scaled.cwiseAbs().maxCoeff(&report.condition);
    report.residual = t.residual[report.condition];
  }

  /// The state at the end of the increment; the committed state and false after a failure.
  std::pair<PointState, bool> solve() const {
    TrialIncrement current = evaluated(Vector6::Zero(), start);
    bool differentiated = false; // whether the stiffness is that at `current`
    for (int i = 0; i < options.max_iterations; ++i, ++report.iterations) {
      if (i > 0 && current.error <= 1) return {std::move(current.answer), true};
      const double before = current.error;
      const bool first = i == 0;
      if (!take_step(current, correction(current), first, differentiated || first ? 6 : 0)) {
        if (differentiated || first || !differentiate(current)) return {start, false};
        differentiated = true;
        continue;
      }
      differentiated = current.error > 1 && !first && current.error > 0.1 * before && differentiate(current);
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
    const NewtonSolve newton{material, control,   options, point, target, (target - at) * duration,
                             scale,    stiffness, report};
    auto [answer, converged] = newton.solve();
    if (converged) {
      point = std::move(answer);
      at = target;
      step *= 2; // back towards the whole increment
      continue;
    }
    report.fraction = target;
    if (step / 2 < smallest) {
      report.converged = false;
      if (report.finite &&
          !report.refused) { // the residual at the end of the whole increment, not of its last part
        const NewtonSolve whole{material, control,   options, point, to, (to - at) * duration,
                                scale,    stiffness, report};
        whole.record(whole.evaluated(Vector6::Zero(), point));
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
