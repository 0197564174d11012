// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/units.hpp"
#include <algorithm>
#include <iterator>

namespace drivers {
namespace {

// The first names of a size are those of messages. "mPa" and "mpa" are left out: they may be milli or mega.
constexpr Unit units[] = {{"1", UnitKind::ratio, 1},
                          {"%", UnitKind::ratio, 0.01},
                          {"permille", UnitKind::ratio, 1e-3},
                          {"-", UnitKind::ratio, 1},
                          {"percent", UnitKind::ratio, 0.01},
                          {"\xE2\x80\xB0", UnitKind::ratio, 1e-3},
                          {"Pa", UnitKind::stress, 1},
                          {"hPa", UnitKind::stress, 100},
                          {"kPa", UnitKind::stress, 1e3},
                          {"MPa", UnitKind::stress, 1e6},
                          {"kN/m2", UnitKind::stress, 1e3},
                          {"N/mm2", UnitKind::stress, 1e6},
                          {"bar", UnitKind::stress, 1e5},
                          {"psi", UnitKind::stress, 6894.757293168},
                          {"KPa", UnitKind::stress, 1e3},
                          {"kpa", UnitKind::stress, 1e3},
                          {"KPA", UnitKind::stress, 1e3},
                          {"Mpa", UnitKind::stress, 1e6},
                          {"MPA", UnitKind::stress, 1e6},
                          {"kN/m^2", UnitKind::stress, 1e3},
                          {"kN/m\xC2\xB2", UnitKind::stress, 1e3},
                          {"N/mm^2", UnitKind::stress, 1e6},
                          {"N/mm\xC2\xB2", UnitKind::stress, 1e6},
                          {"m", UnitKind::length, 1},
                          {"cm", UnitKind::length, 1e-2},
                          {"mm", UnitKind::length, 1e-3},
                          {"m2", UnitKind::area, 1},
                          {"cm2", UnitKind::area, 1e-4},
                          {"mm2", UnitKind::area, 1e-6},
                          {"m3", UnitKind::volume, 1},
                          {"cm3", UnitKind::volume, 1e-6},
                          {"mm3", UnitKind::volume, 1e-9},
                          {"ml", UnitKind::volume, 1e-6},
                          {"mL", UnitKind::volume, 1e-6},
                          {"cc", UnitKind::volume, 1e-6},
                          {"cm^3", UnitKind::volume, 1e-6},
                          {"mm^3", UnitKind::volume, 1e-9},
                          {"cm\xC2\xB3", UnitKind::volume, 1e-6},
                          {"mm\xC2\xB3", UnitKind::volume, 1e-9},
                          {"N", UnitKind::force, 1},
                          {"kN", UnitKind::force, 1e3},
                          {"s", UnitKind::time, 1},
                          {"min", UnitKind::time, 60},
                          {"h", UnitKind::time, 3600},
                          {"sec", UnitKind::time, 1}};

} // namespace

const Unit* find_unit(std::string_view name) {
  const auto found =
      std::find_if(std::begin(units), std::end(units), [&](const Unit& u) { return u.name == name; });
  return found == std::end(units) ? nullptr : found;
}

std::string unit_names(UnitKind kind) {
  std::string out;
  for (const auto& u : units)
    if (u.kind == kind) out += (out.empty() ? "" : ", ") + std::string(u.name);
  return out;
}

std::string_view kind_name(UnitKind kind) {
  constexpr std::string_view names[] = {"a strain or ratio", "a stress", "a length", "an area",
                                        "a volume",          "a force",  "a time"};
  return names[std::size_t(kind)];
}

} // namespace drivers
