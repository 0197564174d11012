// SPDX-License-Identifier: BSD-3-Clause
// The material at single points, called through the VUMAT interface, and measures of stress and strain.
//
// Sign: compression positive, turned once at the call. Components 11, 22, 33, 12, 23, 31; shear
// strains are tensor components (half the engineering shear). Stress effective, Pa. Strain is the
// sum of the increments given to the material (logarithmic for coaxial paths).
//
// All of it is in the corotational frame, whose axes turn with R of F = R U. A point that is led by stress and
// strain has no other axes: R stays, F moves by U alone (host/material/kinematics.hpp, strained). F and U are
// followed for materials of Frame::green_naghdi, others are shown unity.
#pragma once
#include "host/material/reproducer.hpp"
#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace drivers {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What a point carries from one increment to the next.
struct PointState {
  Vector6 stress = Vector6::Zero(), strain = Vector6::Zero();
  std::vector<double> state;                        ///< STATEV
  double internal_energy = 0, inelastic_energy = 0; ///< J/kg
  double initial_density = 1;                       ///< kg/m3, at zero strain
  double time = 0;                                  ///< s
  host::Tensor gradient = host::Tensor::Identity(); ///< F, base axes
};

/// Whether stress, state and energies are numbers.
bool is_finite(const PointState& point);
double mean_stress(const Vector6& stress);       ///< p, Pa
double deviatoric_stress(const Vector6& stress); ///< q = sqrt(3/2 s:s), Pa
double volumetric_strain(const Vector6& strain);
/// sqrt(2/3 e:e) of the deviatoric strain e.
double deviatoric_strain(const Vector6& strain);
/// Degrees, -30 in triaxial compression, +30 in extension; 0 where q vanishes.
double lode_angle(const Vector6& stress);

/// Stress of a point in base axes, R stress R^T.
Vector6 stress_in_base_axes(const PointState& point);

/// A material and the blocks it is called with, kept from call to call. One caller per thread.
class MaterialCaller {
public:
  /// `failure_state`: position in STATEV, from 0, of a variable that is negative after a failed update.
  explicit MaterialCaller(host::Material material, int failure_state = -1)
      : material(std::move(material)), failure_state(failure_state) {}

  /// Answers to one strain increment per point, in blocks as large as the convention allows. `from`
  /// holds one state per increment, or a single one from which all increments start.
  std::vector<PointState> respond(std::span<const PointState> from, std::span<const Vector6> increments,
                                  double dt);
  /// Answer to a known motion from where the point is, whatever the material's frame.
  PointState follow(const PointState& from, const host::Kinematics& motion, double dt);
  /// Stiffness d stress / d strain by the data check, Pa: elastic, whatever the loading direction.
  Matrix6 elastic_stiffness(const PointState& from);

  bool refused(const PointState& answer) const {
    return failure_state >= 0 && answer.state[failure_state] < 0;
  }

  /// Whether an answer may be gone on from.
  bool usable(const PointState& answer) const { return is_finite(answer) && !refused(answer); }
  /// What is known of the last answer that was not usable, in one line. Writes its reproducer to `file`, unless that
  /// is empty.
  std::string evidence(const std::filesystem::path& file) const;

  const host::Material material;
  const int failure_state;
  long points_called = 0;
  std::size_t failed_point = 0; ///< which of those given to `respond` the last unusable answer belongs to

private:
  /// Calls the material with a block whose first point is number `first` of those given.
  void call(const host::Increment& increment, std::size_t first, host::VumatBlock& block);
  host::VumatBlock& block(int points);
  void pack(const PointState& from, const Vector6& increment, int k, host::VumatBlock& block) const;
  std::map<int, host::VumatBlock> blocks;
  std::optional<host::BadAnswer> last_failure;
};

} // namespace drivers
