// SPDX-License-Identifier: BSD-3-Clause
// `simsand info`: what is in a result or a checkpoint.
#pragma once
#include <string>

namespace drivers {

/// A page for people, or, with `json`, one JSON object with all numbers in SI units, null where there is none. Throws
/// std::runtime_error naming the file if it is neither a result nor a checkpoint.
std::string describe_file(const std::string& file, bool json);

} // namespace drivers
