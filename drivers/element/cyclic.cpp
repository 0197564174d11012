// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/cyclic.hpp"

namespace drivers {
namespace {

CyclicLimit read_limit(const TomlTable& table) {
  CyclicLimit limit{find_linear_quantity(table.text("quantity", linear_quantity_names())),
                    table.number("lower"), table.number("upper")};
  if (!(limit.lower < limit.upper)) table.fail("upper", "a number above 'lower'", toml_number(limit.upper));
  return limit;
}

} // namespace

Cycling read_cycling(const TomlTable& table) {
  Cycling c;
  for (const auto& limit : table.tables("limits", 1)) c.limits.push_back(read_limit(limit));
  c.cycles = table.integer("cycles", {1, 1e6});
  c.upwards = table.text("start", {"upper", "lower"}, "upper") == "upper";
  c.leg_increments = table.integer("leg_increments", {1, 1e9}, c.leg_increments);
  return c;
}

} // namespace drivers
