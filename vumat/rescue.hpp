// SPDX-License-Identifier: BSD-3-Clause
// The rescue: the whole increment of one point that the update leaves unsolved. Grains that separate or meet, zero
// pressure, strains beyond the series of (10), and substeps that Newton's rule does not solve.
#pragma once
#include "vumat/update.hpp"

namespace simsand {

/// Most substeps of one increment and evaluations of (16) in them, together. They bound the time that one point may take,
/// to about 5 ms. Ordinary sand needs a hundred, and some thousands where it changes between contact and separation
/// again and again.
inline constexpr int largest_work = 32768;

/// Leads a point through its increment, from the start. The status is that of the end, or `unsolved`. Returns substeps and
/// evaluations made; they exceed `largest_work` by those of one substep at most.
template <class T, int N> int rescue(const Material<T>& m, IncrementProgress<T, N>& at) noexcept;

} // namespace simsand
