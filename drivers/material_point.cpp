// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/material_point.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace drivers {
namespace {

/// Tensor of the six components; weights of a double contraction.
Eigen::Matrix3d tensor(const Vector6& v) {
  return Eigen::Matrix3d{{v[0], v[3], v[5]}, {v[3], v[1], v[4]}, {v[5], v[4], v[2]}};
}

Vector6 deviator(const Vector6& v) {
  Vector6 s = v;
  s.head<3>().array() -= v.head<3>().mean();
  return s;
}

double contraction(const Vector6& a, const Vector6& b) {
  return a.head<3>().dot(b.head<3>()) + 2 * a.tail<3>().dot(b.tail<3>());
}

/// Stretch of a motion without rotation: the exponential of the strain, which turns tension positive.
Eigen::Matrix3d stretch(const Vector6& strain) {
  if (strain.tail<3>().isZero(0)) return Eigen::Vector3d((-strain.head<3>()).array().exp()).asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(-tensor(strain));
  const Eigen::Vector3d principal = solver.eigenvalues().array().exp();
  return solver.eigenvectors() * principal.asDiagonal() * solver.eigenvectors().transpose();
}

/// Places of the non-symmetric order 11, 22, 33, 12, 23, 31, 21, 32, 13; the first six are also those
/// of the symmetric one.
constexpr std::array<std::array<int, 2>, 9> places{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}}};

void put_stretch(const Vector6& strain, int k, int points, std::vector<double>& u, std::vector<double>& f) {
  const auto value = stretch(strain);
  for (int c = 0; c < 9; ++c) {
    f[c * points + k] = value(places[c][0], places[c][1]);
    if (c < 6) u[c * points + k] = f[c * points + k];
  }
}

void put(const PointState& from, const Vector6& increment, int k, host::VumatBlock& b) {
  const int n = b.points;
  for (int c = 0; c < 6; ++c) {
    b.strain_increment[c * n + k] = -increment[c];
    b.stress_old[c * n + k] = -from.stress[c];
  }
  for (int c = 0; c < b.state_variables; ++c) b.state_old[c * n + k] = from.state[c];
  put_stretch(from.strain, k, n, b.stretch_old, b.gradient_old);
  put_stretch(from.strain + increment, k, n, b.stretch_new, b.gradient_new);
  // The convention's density is that in the middle of the increment.
  b.density[k] = from.initial_density * std::exp(volumetric_strain(from.strain + 0.5 * increment));
  b.internal_energy_old[k] = from.internal_energy;
  b.inelastic_energy_old[k] = from.inelastic_energy;
  b.char_length[k] = 1; // m; one element of unit size
}

PointState taken(const PointState& from, const Vector6& increment, double dt, int k,
                 const host::VumatBlock& b) {
  const int n = b.points;
  PointState to = from;
  for (int c = 0; c < 6; ++c) to.stress[c] = -b.stress_new[c * n + k];
  for (int c = 0; c < b.state_variables; ++c) to.state[c] = b.state_new[c * n + k];
  to.strain = from.strain + increment;
  to.internal_energy = b.internal_energy_new[k];
  to.inelastic_energy = b.inelastic_energy_new[k];
  to.time = from.time + dt;
  return to;
}

} // namespace

double mean_stress(const Vector6& stress) {
  return stress.head<3>().mean();
}

double deviatoric_stress(const Vector6& stress) {
  const auto s = deviator(stress);
  return std::sqrt(1.5 * contraction(s, s));
}

double volumetric_strain(const Vector6& strain) {
  return strain.head<3>().sum();
}

double deviatoric_strain(const Vector6& strain) {
  const auto e = deviator(strain);
  return std::sqrt(contraction(e, e) / 1.5);
}

double lode_angle(const Vector6& stress) {
  const double q = deviatoric_stress(stress), third = tensor(deviator(stress)).determinant();
  if (!(q > 1e-9 * stress.norm())) return 0; // round-off
  return std::asin(std::clamp(-13.5 * third / (q * q * q), -1.0, 1.0)) * 180 / (3 * M_PI);
}

host::VumatBlock& MaterialCaller::block(int points) {
  return blocks.try_emplace(points, material, points, 3).first->second;
}

std::vector<PointState> MaterialCaller::respond(std::span<const PointState> from,
                                                std::span<const Vector6> increments, double dt) {
  std::vector<PointState> answers;
  answers.reserve(increments.size());
  const auto start = [&](std::size_t i) -> const PointState& { return from[from.size() == 1 ? 0 : i]; };
  for (std::size_t first = 0; first < increments.size(); first += vumat::max_block) {
    const int n = int(std::min<std::size_t>(vumat::max_block, increments.size() - first));
    auto& b = block(n);
    for (int k = 0; k < n; ++k) put(start(first + k), increments[first + k], k, b);
    const double end = start(first).time + dt;
    host::call_vumat(material, {end, end, dt}, b);
    for (int k = 0; k < n; ++k) answers.push_back(taken(start(first + k), increments[first + k], dt, k, b));
    points_called += n;
  }
  return answers;
}

Matrix6 MaterialCaller::elastic_stiffness(const PointState& from) {
  constexpr double probe = 1e-8; // small against the strain over which moduli change
  auto& b = block(6);
  for (int k = 0; k < 6; ++k) put(from, probe * Vector6::Unit(k), k, b);
  host::call_vumat(material, {0, 0, 1}, b);
  points_called += 6;
  Matrix6 stiffness;
  for (int k = 0; k < 6; ++k)
    stiffness.col(k) = (taken(from, Vector6::Zero(), 0, k, b).stress - from.stress) / probe;
  return stiffness;
}

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
    const bool finite = t.answer.stress.allFinite();
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

  /// Broyden's update: the stiffness that explains the step from one trial to the next.
  void learn(const Trial& from, const Trial& to) const {
    const Vector6 step = to.increment - from.increment;
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
    report.finite = t.answer.stress.allFinite();
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
      if (first && current.error > 1e4) fresh = differentiate(current);
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
      return report;
    }
    ++report.cuts;
    step /= 2;
    if (const auto elastic = material.elastic_stiffness(point); elastic.allFinite()) stiffness = elastic;
  }
  return report;
}

} // namespace drivers
