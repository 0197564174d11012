// SPDX-License-Identifier: BSD-3-Clause
// Particle fields as rows in the order of creation, which no sorting changes.
#pragma once
#include "host/files/output.hpp"

namespace host {

/// Components interleaved, one vector per field; all before the first is written: a misfit leaves nothing
/// behind. Row i of a field belongs to particle original[i], as for ResultFile::snapshot. Throws
/// std::invalid_argument unless every one of `particles` has its row.
std::vector<std::vector<double>> in_original_order(std::span<const Field> fields,
                                                   std::span<const std::int32_t> original,
                                                   std::size_t particles);

} // namespace host
