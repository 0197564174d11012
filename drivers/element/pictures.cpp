// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/element/pictures.hpp"
#include "drivers/files/resource.hpp"
#include "drivers/run/process.hpp"
#include <fmt/format.h>
#include <stdexcept>

namespace drivers {
namespace {

Words critical_numbers(const std::optional<CriticalState>& critical) {
  if (!critical) return {"nan", "nan", "nan", "nan", "nan", "nan"};
  Words out;
  for (const double v : {critical->friction_angle, critical->e_ref, critical->lambda, critical->zeta,
                         critical->p_at, critical->p_min})
    out.push_back(fmt::format("{}", v));
  return out;
}

} // namespace

void run_script(const std::string& name, const Words& arguments, const std::string& folder) {
  const auto script = resource(name);
  if (const int status = run_python(script, arguments); status != 0)
    throw std::runtime_error(
        fmt::format("{}: figures were not drawn: {} ended with status {}", folder, script, status));
}

void draw_pictures(const std::vector<Picture>& pictures, const std::string& folder) {
  if (pictures.empty()) return;
  Words arguments{"-o", folder};
  for (const auto& picture : pictures) {
    arguments.emplace_back("--critical");
    for (const auto& number : critical_numbers(picture.critical)) arguments.push_back(number);
  }
  arguments.emplace_back("--");
  for (const auto& picture : pictures) arguments.push_back(picture.table);
  run_script("figures/element_figures.py", arguments, folder);
}

} // namespace drivers
