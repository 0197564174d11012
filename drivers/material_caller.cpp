// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/material_caller.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

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

} // namespace drivers
