// SPDX-License-Identifier: BSD-3-Clause
// The material at single points, called through the VUMAT interface, and measures of stress and strain.
//
// Sign: compression positive, turned once at the call. Components 11, 22, 33, 12, 23, 31; shear
// strains are tensor components (half the engineering shear). Stress effective, Pa. Strain is the
// sum of the increments given to the material (logarithmic for coaxial paths).
//
// All components are in the corotational frame, whose axes rotate with R of F = R U. A point that is led by stress and
// strain has no other axes: R stays and F changes by U alone (motion_by_strain in host/material/kinematics.hpp). F and U
// are followed for materials of Frame::green_naghdi; others get the identity.
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

/// The state of a point between two increments.
struct PointState {
  Vector6 stress = Vector6::Zero(), strain = Vector6::Zero();
  std::vector<double> state;                        ///< STATEV
  double internal_energy = 0, inelastic_energy = 0; ///< J/kg
  double initial_density = 1;                       ///< kg/m3, at zero strain
  double time = 0;                                  ///< s
  host::Tensor gradient = host::Tensor::Identity(); ///< F, base axes
};

/// True if stress, state and energies are finite.
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

/// Calls a material, with blocks that are kept from call to call. One for each thread.
class MaterialCaller {
public:
  /// `failure_state`: position in STATEV, from 0, of a variable that is negative after a failed update.
  explicit MaterialCaller(host::Material material, int failure_state = -1)
      : material(std::move(material)), failure_state(failure_state) {}

  /// States after one strain increment for each point, called in blocks as large as the convention allows. `from` holds
  /// one state for each increment, or a single one from which all increments start. `dt` in s.
  std::vector<PointState> respond(std::span<const PointState> from, std::span<const Vector6> increments,
                                  double dt);
  /// State after a given motion, whatever the material's frame.
  PointState follow(const PointState& from, const host::Kinematics& motion, double dt);
  /// Stiffness d stress / d strain by the data check, Pa: elastic, whatever the loading direction.
  Matrix6 elastic_stiffness(const PointState& from);

  bool refused(const PointState& answer) const {
    return failure_state >= 0 && answer.state[failure_state] < 0;
  }

  /// True if a state is finite and the material reports no failure.
  bool usable(const PointState& answer) const { return is_finite(answer) && !refused(answer); }
  /// One line about the last call whose results were not usable. Writes its reproducer to `file`, unless that is empty.
  std::string evidence(const std::filesystem::path& file) const;

  const host::Material material;
  const int failure_state;
  long points_called = 0;
  std::size_t failed_point =
      0; ///< index in what was given to `respond` of the point whose results were not usable last

private:
  /// Calls the material with a block whose first point is number `first` of those given.
  void call(const host::Increment& increment, std::size_t first, host::VumatBlock& block);
  host::VumatBlock& block(int points);
  void pack(const PointState& from, const Vector6& increment, int k, host::VumatBlock& block) const;
  std::map<int, host::VumatBlock> blocks;
  std::optional<host::BadAnswer> last_failure;
};

} // namespace drivers
