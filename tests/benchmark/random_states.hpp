// SPDX-License-Identifier: BSD-3-Clause
// Random points under stress, at about half of their strength, that are sheared on.
#pragma once
#include "tests/benchmark/states.hpp"
#include <array>

namespace benchmark {

/// `count` points of the sand SS, 50 Pa to 2 kPa, void ratio 0.58 to 0.8; strain of a length within
/// 10^decades, its direction that of the stress and as much of any other, and some volume. 6 components.
States random_states(int count, std::array<double, 2> decades);

} // namespace benchmark
