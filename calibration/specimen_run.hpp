// SPDX-License-Identifier: BSD-3-Clause
// One specimen during its test: the size of its increments of axial strain, and the trials of radial strain in each. It
// calls no material: the caller asks for the strain increment to try and passes the answer, so that many specimens can
// share a call.
#pragma once
#include "calibration/path.hpp"
#include "calibration/radial_strain_search.hpp"

namespace calibration {

/// Size of increments: the straight continuation of the last increment differs from the next one by about these in
/// stress (over p) and volumetric strain. Errors of the result are far smaller.
struct Accuracy {
  double stress = 5e-4, volumetric_strain = 5e-5;
  double largest_increment = 0.01; ///< of axial strain
  double control = 1e-6;           ///< error of a held stress, over the initial mean stress
};

/// The material's answer to a strain increment.
struct MaterialAnswer {
  drivers::AxisymmetricTensor stress; ///< Pa
  bool usable;                        ///< finite, and no failure reported
  bool substepped;                    ///< the material cut the increment into substeps
};

/// The result of a trial.
enum class TrialOutcome {
  retry,    ///< another trial starts from the same state
  accepted, ///< the increment is complete, the next one starts from its state
  ended     ///< the test is over: its end was reached, or the material failed
};

class SpecimenRun {
public:
  /// All three outlive the run.
  SpecimenRun(const Specimen& specimen, const Accuracy& accuracy, Path& path)
      : specimen(&specimen), accuracy(&accuracy), path(&path) {}

  /// Starts the test anew; the path receives the initial row.
  void begin();
  /// Takes the answer to an update without strain, which sets stress and state for the void ratio. False: unusable.
  bool take_initial_answer(const MaterialAnswer& answer);
  /// The strain increment to try from `stress`.
  drivers::AxisymmetricTensor trial() const { return {axial_increment, search.trial}; }
  /// Takes the answer to the trial.
  TrialOutcome take_answer(const MaterialAnswer& answer);

  drivers::AxisymmetricTensor stress; ///< at the start of the increment, Pa
  std::vector<double> state;          ///< STATEV there; the caller updates it

private:
  struct AcceptedIncrement {
    double axial = 0, ratio = 0; ///< axial strain; radial over axial strain
  };

  void begin_increment();
  TrialOutcome shorten_increment();
  double deviation_from_line(const drivers::AxisymmetricTensor& next_stress,
                             double next_volumetric_strain) const;
  TrialOutcome next_increment(double deviation);

  const Specimen* specimen;
  const Accuracy* accuracy;
  Path* path;
  drivers::AxisymmetricTensor strain;
  double held = 0; ///< left-hand side of the held condition at the start
  double axial_increment = 0;
  RadialStrainSearch search;
  AcceptedIncrement last, before; ///< the last increment and the one before
  int increments = 0;
  double longest = 1; ///< axial increment that the material is expected to take without substeps
  double slope = 0;   ///< of the search for the last increment
};

} // namespace calibration
