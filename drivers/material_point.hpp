// SPDX-License-Identifier: BSD-3-Clause
// One material point under mixed control: the strain increment that satisfies six linear
// restrictions on stress and strain, found by Newton's method through the VUMAT interface.
//
// Sign: compression positive, turned once at the call. Components 11, 22, 33, 12, 23, 31; shear
// strains are tensor components (half the engineering shear). Stress effective, Pa. Strain is the
// sum of the increments given to the material (logarithmic for coaxial paths).
#pragma once
#include "host/vumat_block.hpp"
#include <Eigen/Core>
#include <map>
#include <span>
#include <string>
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
};

double mean_stress(const Vector6& stress);       ///< p, Pa
double deviatoric_stress(const Vector6& stress); ///< q = sqrt(3/2 s:s), Pa
double volumetric_strain(const Vector6& strain);
/// sqrt(2/3 e:e) of the deviatoric strain e.
double deviatoric_strain(const Vector6& strain);
/// Degrees, -30 in triaxial compression, +30 in extension; 0 where q vanishes.
double lode_angle(const Vector6& stress);

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
  /// Stiffness d stress / d strain by the data check, Pa: elastic, whatever the loading direction.
  Matrix6 elastic_stiffness(const PointState& from);

  bool refused(const PointState& answer) const {
    return failure_state >= 0 && answer.state[failure_state] < 0;
  }

  const host::Material material;
  const int failure_state;
  long points_called = 0;

private:
  host::VumatBlock& block(int points);
  std::map<int, host::VumatBlock> blocks;
};

/// stress * sigma + strain * epsilon = at_start + fraction * change, for sigma and epsilon of the
/// point at a fraction 0 to 1 of the stage. Absolute, so that errors of single steps do not add up.
struct MixedControl {
  Matrix6 stress = Matrix6::Zero(), strain = Matrix6::Zero();
  Vector6 at_start = Vector6::Zero(), change = Vector6::Zero();
};

struct NewtonOptions {
  double tolerance = 1e-9;    ///< of each restriction, relative to the stress level
  int max_iterations = 20;    ///< before the increment is cut in half
  int max_cuts = 16;          ///< halvings of one increment
  double lowest_level = 1e-6; ///< smallest stress level of the tolerance, relative to the stage's
};

/// Effort and, after a failure, evidence.
struct StepReport {
  int iterations = 0, cuts = 0;
  bool converged = true;
  bool finite = true;   ///< the material returned numbers
  bool refused = false; ///< the material reported failure
  int restriction = 0;  ///< the one least satisfied, from 0
  double residual = 0;  ///< of that restriction, in its own unit
  double fraction = 0;  ///< of the stage, that could not be reached
};

/// What is large and small in a stage: stress and stiffness where it began, Pa.
struct StageScale {
  double stress, modulus;
};
StageScale scale_of(const Vector6& stress, const Matrix6& stiffness);

/// Takes `point` from one fraction of a stage to another, cutting the increment where Newton's method
/// fails. `stiffness` is the first guess and becomes that of the last iteration. After a failure
/// `point` is where the last converged part of the increment left it.
StepReport advance(MaterialCaller& material, const MixedControl& control, double from, double to,
                   double duration, const StageScale& scale, const NewtonOptions& options, PointState& point,
                   Matrix6& stiffness);

} // namespace drivers
