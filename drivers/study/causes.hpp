// SPDX-License-Identifier: BSD-3-Clause
// `simsand study causes`: columns with the calibrated set, where SPH and discrete elements of the same grains differ
// most, with one thing changed at a time: parameters, boundary, scheme. Manual and results: COLUMNS.md.
#pragma once
#include "drivers/study/runs.hpp"

namespace drivers {

struct CauseStudyOptions {
  StudyOptions study{"results/causes", ""};
  double spacing = 2e-3; ///< m, of all but those about spacing and dimension
};

/// Runs what is missing, then writes the table, the pictures and the page. Errors: as study_columns.
void study_causes(const CauseStudyOptions& options);

} // namespace drivers
