// SPDX-License-Identifier: BSD-3-Clause
// The rescue: the whole increment of one point that the update leaves unsolved. Grains that separate or meet, zero
// pressure, strains beyond the series of (10), and substeps that Newton's rule does not solve.
#pragma once
#include "vumat/update.hpp"

namespace simsand {

/// Leads a point through its increment, from the start. The status is that of the end, or `unsolved`.
template <class T, int N> void rescue(const Material<T>& m, IncrementProgress<T, N>& at) noexcept;

} // namespace simsand
