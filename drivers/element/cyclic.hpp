// SPDX-License-Identifier: BSD-3-Clause
// Cyclic loading: the drive of a stage goes forth and back, and turns where a quantity meets its limit.
#pragma once
#include "drivers/element/condition.hpp"
#include "drivers/files/toml_table.hpp"

namespace drivers {

/// Bounds between which a quantity swings. A limit on strain is a change since the start of the stage.
struct CyclicLimit {
  const LinearQuantity* quantity;
  double lower, upper;
};

struct Cycling {
  std::vector<CyclicLimit> limits;        ///< the first that is met turns the drive
  long cycles = 1;                        ///< each from upper to upper limit, or from lower to lower
  bool upwards = true;                    ///< of the first leg
  double increment = 0;                   ///< of the drive, positive; Pa or strain
  long leg_increments = 100000;           ///< a leg that needs more is an error
  const LinearQuantity* strain = nullptr; ///< whose double amplitude is reported
};

/// Reads `[stage.cyclic]` but the drive and its increment.
Cycling read_cycling(const TomlTable& table);

} // namespace drivers
