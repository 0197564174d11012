// SPDX-License-Identifier: BSD-3-Clause
// One specimen on its way through its test: how long its increments are, and which radial strain each of them is tried
// with. It calls no material: whoever does asks for the strain increment to try and hands over the answer, so that many
// specimens can share a call.
#pragma once
#include "calibration/path.hpp"
#include "calibration/radial_strain_search.hpp"

namespace calibration {

/// Size of increments. Where the path bends, an increment is so small that a straight continuation of the one
/// before misses stress (over p) and volumetric strain by about this; errors of the result are far smaller.
struct Accuracy {
  double stress = 5e-4, volumetric_strain = 5e-5;
  double largest_increment = 0.01; ///< of axial strain
  double control = 1e-6;           ///< error of a held stress, over the initial mean stress
};

/// What the material answers to a strain increment.
struct MaterialAnswer {
  drivers::AxisymmetricTensor stress; ///< Pa
  bool usable;                        ///< numbers, and no failure reported
  bool substepped;                    ///< the material cut the increment into substeps
};

/// What becomes of a trial.
enum class TrialOutcome {
  retry,    ///< there is another trial from the same state
  accepted, ///< the increment stands, the next one begins from its state
  ended     ///< the test is over: its end was reached, or the material failed
};

class SpecimenRun {
public:
  /// All three outlive the run.
  SpecimenRun(const Specimen& specimen, const Accuracy& accuracy, Path& path)
      : specimen(&specimen), accuracy(&accuracy), path(&path) {}

  /// Begins the test anew, with the row of the start.
  void begin();
  /// Takes the answer to an update without strain, which adapts stress and state to the void ratio. False: unusable.
  bool settle(const MaterialAnswer& answer);
  /// The strain increment to try from `stress`.
  drivers::AxisymmetricTensor trial() const { return {axial_increment, search.trial}; }
  /// Takes the answer to the trial.
  TrialOutcome take(const MaterialAnswer& answer);

  drivers::AxisymmetricTensor stress; ///< at the start of the increment, Pa
  std::vector<double> state;          ///< STATEV there; the caller keeps it

private:
  /// An increment that stands.
  struct Done {
    double axial = 0, ratio = 0; ///< axial strain; radial over axial strain
  };

  void begin_increment();
  TrialOutcome shorten();
  double bend(const drivers::AxisymmetricTensor& next_stress, double next_volumetric_strain) const;
  void accept(const MaterialAnswer& answer);
  TrialOutcome go_on(double bend);

  const Specimen* specimen;
  const Accuracy* accuracy;
  Path* path;
  drivers::AxisymmetricTensor strain;
  double held = 0; ///< left-hand side of the held condition at the start
  double axial_increment = 0;
  RadialStrainSearch search;
  Done last, before; ///< the last two increments
  int increments = 0;
  double longest = 1; ///< axial increment that the material is expected to take without substeps
  double slope = 0;   ///< of the search for the last increment
};

} // namespace calibration
