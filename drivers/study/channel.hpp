// SPDX-License-Identifier: BSD-3-Clause
// `simsand study channel`: the rods of Bui et al. (2008), 0.20 m x 0.10 m in plane strain, with SIMSAND at four void
// ratios and with Drucker-Prager. Manual and results: CHANNEL.md.
#pragma once
#include "drivers/study/runs.hpp"

namespace drivers {

struct ChannelStudyOptions {
  StudyOptions study{"results/channel", ""};
  double spacing = 2e-3; ///< m
};

/// Runs what is missing, then writes the table, the pictures and the page. Errors: as study_columns.
void study_channel(const ChannelStudyOptions& options);

} // namespace drivers
