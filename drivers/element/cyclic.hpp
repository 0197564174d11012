// SPDX-License-Identifier: BSD-3-Clause
// Cyclic loading: the driven quantity of a stage goes to and fro, and reverses where a quantity meets its limit.
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
  std::vector<CyclicLimit> limits;        ///< the first that is met reverses the loading
  long cycles = 1;                        ///< each from upper to upper limit, or from lower to lower
  bool upwards = true;                    ///< direction of the first leg (half cycle)
  double increment = 0;                   ///< of the driven quantity, positive; Pa or strain
  long leg_increments = 100000;           ///< a leg that needs more is an error
  const LinearQuantity* strain = nullptr; ///< whose double amplitude is reported
};

/// Reads `[stage.cyclic]` except the driven quantity and its increment.
Cycling read_cycling(const TomlTable& table);

} // namespace drivers
