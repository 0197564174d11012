// SPDX-License-Identifier: BSD-3-Clause
// The page beside a deck: how to run it, what it assumes, how to read height and runout.
#pragma once
#include "drivers/abaqus/deck.hpp"

namespace drivers {

/// Markdown.
std::string abaqus_page(const host::Scene& scene, const AbaqusModel& model, bool with_source);

} // namespace drivers
