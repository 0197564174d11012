// SPDX-License-Identifier: BSD-3-Clause
// What makes two scenes different runs.
#pragma once
#include <optional>
#include <string>

namespace drivers {

/// The first key, in alphabetical order, by which the resolved scene `now` differs from `before` in what it
/// computes, with both values, as a clause. Where results go, how often checkpoints are written and where the
/// material library lies make no difference. Empty if there is none.
std::optional<std::string> scene_difference(const std::string& before, const std::string& now);

} // namespace drivers
