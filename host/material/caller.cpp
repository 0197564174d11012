// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/caller.hpp"
#include "host/material/point_block.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace drivers {
namespace {

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

Vector6 components(const Eigen::Matrix3d& t) {
  return (Vector6() << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)).finished();
}

constexpr int shear = 3; // components
using Six = std::span<const double, 6>;

/// Sets F, U and spin of point k.
void set_motion(const host::Kinematics& motion, int k, host::VumatBlock& b) {
  const int n = b.points;
  host::set_symmetric(motion.stretch_old, k, n, shear, b.stretch_old);
  host::set_symmetric(motion.stretch_new, k, n, shear, b.stretch_new);
  host::set_general(motion.gradient_old, k, n, shear, b.gradient_old);
  host::set_general(motion.gradient_new, k, n, shear, b.gradient_new);
  b.kept_gradient.resize(n);
  b.kept_gradient[k] = motion.gradient_new;
  for (int s = 0; s < shear; ++s) b.spin_increment[s * n + k] = motion.spin[s];
}

/// Sets strain increment, stress, state, density and energies of point k.
void set_point(const PointState& from, const Vector6& increment, int k, host::VumatBlock& b) {
  host::pack_point(Six(from.stress.data(), 6), Six(increment.data(), 6), from.state, k, b);
  // The convention's density is that in the middle of the increment.
  b.density[k] = from.initial_density * std::exp(volumetric_strain(from.strain + 0.5 * increment));
  b.internal_energy_old[k] = from.internal_energy;
  b.inelastic_energy_old[k] = from.inelastic_energy;
  b.char_length[k] = 1; // m; one element of unit size
}

/// The state of point k after a call.
PointState state_after(const PointState& from, const Vector6& increment, double dt, int k,
                       const host::VumatBlock& b) {
  PointState to = from;
  host::unpack_stress(b, k, std::span<double, 6>(to.stress.data(), 6));
  host::unpack_state(b, k, to.state);
  to.strain = from.strain + increment;
  to.internal_energy = b.internal_energy_new[k];
  to.inelastic_energy = b.inelastic_energy_new[k];
  to.time = from.time + dt;
  return to;
}

} // namespace

bool is_finite(const PointState& point) {
  double all = point.stress.sum() * 0 + point.internal_energy * 0 + point.inelastic_energy * 0;
  for (const double x : point.state) all += x * 0;
  return all == 0;
}

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

Vector6 stress_in_base_axes(const PointState& point) {
  const host::Tensor rotation = host::rotation_of(point.gradient);
  if (rotation.isIdentity(1e-15)) return point.stress;
  return components(rotation * tensor(point.stress) * rotation.transpose());
}

host::VumatBlock& MaterialCaller::block(int points) {
  return blocks.try_emplace(points, material, points, shear).first->second;
}

void MaterialCaller::pack(const PointState& from, const Vector6& increment, int k,
                          host::VumatBlock& b) const {
  set_point(from, increment, k, b);
  if (material.frame == host::Frame::green_naghdi)
    set_motion(host::motion_by_strain(from.gradient, -tensor(increment)), k, b);
}

void MaterialCaller::call(const host::Increment& increment, std::size_t first, host::VumatBlock& b) {
  host::call_vumat(material, increment, b);
  points_called += b.points;
  const int k = host::first_failure(b, failure_state);
  if (k < 0) return;
  failed_point = first + std::size_t(k);
  last_failure =
      host::BadAnswer{host::fault_of(b, k, failure_state), host::point_call(material, increment, b, k)};
}

std::string MaterialCaller::evidence(const std::filesystem::path& file) const {
  if (!last_failure) return "the material failed";
  return host::evidence_of(material, failure_state, *last_failure, "", 0, file);
}

std::vector<PointState> MaterialCaller::respond(std::span<const PointState> from,
                                                std::span<const Vector6> increments, double dt) {
  std::vector<PointState> answers;
  answers.reserve(increments.size());
  const auto start = [&](std::size_t i) -> const PointState& { return from[from.size() == 1 ? 0 : i]; };
  for (std::size_t first = 0; first < increments.size(); first += vumat::max_block) {
    const int n = int(std::min<std::size_t>(vumat::max_block, increments.size() - first));
    auto& b = block(n);
    for (int k = 0; k < n; ++k) pack(start(first + k), increments[first + k], k, b);
    const double end = start(first).time + dt;
    call({end, end, dt}, first, b);
    for (int k = 0; k < n; ++k) {
      answers.push_back(state_after(start(first + k), increments[first + k], dt, k, b));
      if (material.frame == host::Frame::green_naghdi) answers.back().gradient = b.kept_gradient[k];
    }
  }
  return answers;
}

PointState MaterialCaller::follow(const PointState& from, const host::Kinematics& motion, double dt) {
  host::VumatBlock b(material, 1, shear); // F and U of the blocks that are kept must stay unity
  const Vector6 increment = -components(motion.strain);
  set_point(from, increment, 0, b);
  set_motion(motion, 0, b);
  const double end = from.time + dt;
  call({end, end, dt}, 0, b);
  auto to = state_after(from, increment, dt, 0, b);
  to.gradient = motion.gradient_new;
  return to;
}

Matrix6 MaterialCaller::elastic_stiffness(const PointState& from) {
  constexpr double probe = 1e-8; // small against the strain over which moduli change
  auto& b = block(6);
  for (int k = 0; k < 6; ++k) pack(from, probe * Vector6::Unit(k), k, b);
  call({0, 0, 1}, 0, b);
  Matrix6 stiffness;
  for (int k = 0; k < 6; ++k)
    stiffness.col(k) = (state_after(from, Vector6::Zero(), 0, k, b).stress - from.stress) / probe;
  return stiffness;
}

} // namespace drivers
