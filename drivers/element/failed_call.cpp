// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/failed_call.hpp"
#include "drivers/files/csv_write.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace drivers {

FailedCall read_failed_call(const TomlTable& document) {
  auto material = read_material(document.table("material"));
  const auto table = document.table("call");
  const long shear = table.integer("nshr", {1, 3});
  if (shear == 2) table.fail("nshr", "1 or 3", "2");
  host::PointCall call{{table.number("stepTime", not_negative), table.number("totalTime", not_negative),
                        table.number("dt", positive)},
                       host::VumatBlock(material.material, 1, int(shear))};
  call.block.elements[0] = int(table.integer("element", {1, 2147483647}, 1));
  host::each_array(call.block, [&](const char* name, host::GuardedArray& a, bool input) {
    if (!input || &a == &call.block.constants || a.size() == 0) return;
    const auto values = table.numbers(name, a.size());
    std::copy(values.begin(), values.end(), a.begin());
  });
  document.finish();
  return {std::move(material), std::move(call)};
}

std::string repeat_call(FailedCall& failed, std::string& fault) {
  auto& b = failed.call.block;
  host::call_vumat(failed.material.material, failed.call.increment, b);
  fault = host::fault_of(b, 0, failed.material.failure_state);
  CsvWriter table("quantity,component,old,new");
  const auto number = [](double x) { return fmt::format("{:.12g}", x); }; // infinities and NaN as such
  const auto row = [&](const std::string& quantity, std::size_t c, const host::GuardedArray& old,
                       const host::GuardedArray& now) {
    table.row(quantity, c + 1, number(old[c]), number(now[c]));
  };
  for (std::size_t c = 0; c < b.stress_new.size(); ++c) row("stress_Pa", c, b.stress_old, b.stress_new);
  for (std::size_t s = 0; s < b.state_new.size(); ++s)
    row("state_" + failed.material.state_names[s], s, b.state_old, b.state_new);
  row("internal_energy_J_per_kg", 0, b.internal_energy_old, b.internal_energy_new);
  row("inelastic_energy_J_per_kg", 0, b.inelastic_energy_old, b.inelastic_energy_new);
  return table.text();
}

} // namespace drivers
