// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/specimen_run.hpp"
#include <algorithm>
#include <cmath>

namespace calibration {
namespace {

using drivers::AxisymmetricTensor;

constexpr double first_increment = 1e-5;    // of axial strain: elastic
constexpr double smallest_increment = 1e-9; // below it the material has failed
constexpr int most_trials = 30;             // of one increment before it is shortened
constexpr std::size_t most_rows = 5000;
constexpr double largest_deviation = 16; // over the allowed one, before an increment is shortened

/// Substeps of the material cost more than increments do: after an increment that needed them the next one is shorter,
/// later ones may grow again.
constexpr double after_substeps = 0.5, without_substeps = 1.1;

} // namespace

void SpecimenRun::begin() {
  *this = SpecimenRun(*specimen, *accuracy, *path);
  stress = {specimen->axial_stress, specimen->radial_stress};
  path->clear();
  path->add(stress, strain);
}

bool SpecimenRun::take_initial_answer(const MaterialAnswer& answer) {
  if (!answer.usable) return false;
  held = specimen->kind->held.at(stress, strain);
  stress = answer.stress;
  last.ratio = specimen->kind->strain_ratio();
  axial_increment =
      std::copysign(std::min(first_increment, std::abs(specimen->end_strain)), specimen->end_strain);
  begin_increment();
  return true;
}

/// First trial: the ratio of strains, which belongs to the middle of an increment, continued from the last two.
void SpecimenRun::begin_increment() {
  double ratio = last.ratio;
  if (increments > 1)
    ratio += (last.ratio - before.ratio) * (axial_increment + last.axial) / (last.axial + before.axial);
  if (!(std::abs(ratio - last.ratio) < 0.5)) ratio = last.ratio;
  search = {};
  search.trial = ratio * axial_increment;
  search.slope = slope;
}

TrialOutcome SpecimenRun::shorten_increment() {
  axial_increment *= 0.25;
  if (std::abs(axial_increment) < smallest_increment) return TrialOutcome::ended;
  begin_increment();
  return TrialOutcome::retry;
}

/// How far a row would be from the straight continuation of the last increment, over what is allowed.
double SpecimenRun::deviation_from_line(const AxisymmetricTensor& next, double volumetric_strain) const {
  const Path& p = *path;
  const std::size_t n = p.rows();
  if (n < 2) return 0.25; // unknown: the second increment is longer
  const AxisymmetricTensor now{p.axial_stress[n - 1], p.radial_stress[n - 1]},
      old{p.axial_stress[n - 2], p.radial_stress[n - 2]};
  const double share = axial_increment / (p.axial_strain[n - 1] - p.axial_strain[n - 2]);
  const double level = std::max({now.trace() / 3, next.trace() / 3, 1e-3 * p.axial_stress[0]});
  const double axial = next.axial - now.axial - share * (now.axial - old.axial);
  const double radial = next.radial - now.radial - share * (now.radial - old.radial);
  const double volume = volumetric_strain - p.volumetric_strain[n - 1] -
                        share * (p.volumetric_strain[n - 1] - p.volumetric_strain[n - 2]);
  return std::max(std::max(std::abs(axial), std::abs(radial)) / (level * accuracy->stress),
                  std::abs(volume) / accuracy->volumetric_strain);
}

TrialOutcome SpecimenRun::take_answer(const MaterialAnswer& answer) {
  if (!answer.usable || search.trials > most_trials) return shorten_increment();
  const AxisymmetricTensor next{strain.axial + axial_increment, strain.radial + search.trial};
  if (!specimen->kind->prescribes_strain()) {
    const double residual = specimen->kind->held.at(answer.stress, next) - held;
    if (std::abs(residual) > accuracy->control * specimen->mean_stress()) {
      search.next(residual, axial_increment);
      return TrialOutcome::retry;
    }
  }
  const double deviation = deviation_from_line(answer.stress, next.trace());
  if (deviation > largest_deviation && std::abs(axial_increment) > first_increment)
    return shorten_increment();
  longest = answer.substepped ? after_substeps * std::abs(axial_increment) : without_substeps * longest;
  stress = answer.stress;
  strain = next;
  path->add(stress, strain);
  return next_increment(deviation);
}

/// Stores the accepted increment and starts the next one.
TrialOutcome SpecimenRun::next_increment(double deviation) {
  slope = search.slope;
  before = last;
  last = {axial_increment, search.trial / axial_increment};
  ++increments;
  path->complete = std::abs(strain.axial) >= std::abs(specimen->end_strain);
  if (path->complete || path->rows() >= most_rows) return TrialOutcome::ended;
  const double grown = std::abs(axial_increment) * std::clamp(0.9 / std::sqrt(deviation), 0.3, 2.0);
  axial_increment =
      std::copysign(std::min({grown, longest, accuracy->largest_increment}), specimen->end_strain);
  begin_increment();
  return TrialOutcome::accepted;
}

} // namespace calibration
