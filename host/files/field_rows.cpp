// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/field_rows.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace host {
namespace {

std::vector<double> in_original_order(const Field& field, std::span<const std::int32_t> original,
                                      std::size_t particles) {
  const std::size_t components = field.components.size();
  if (components == 0) throw std::invalid_argument(fmt::format("field {} has no component", field.name));
  const std::size_t rows = field.components[0].size();
  if (std::any_of(field.components.begin(), field.components.end(),
                  [=](auto c) { return c.size() != rows; }) ||
      (original.empty() ? rows != particles : rows != original.size()))
    throw std::invalid_argument(fmt::format("field {} does not fit {} particles", field.name, particles));
  std::vector<double> values(particles * components);
  std::vector<bool> seen(particles);
  std::size_t written = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::int64_t to = original.empty() ? std::int64_t(i) : original[i];
    if (to < 0) continue;
    if (std::size_t(to) >= particles || seen[to])
      throw std::invalid_argument(fmt::format("field {}: particle number {} out of place", field.name, to));
    seen[to] = true;
    ++written;
    for (std::size_t c = 0; c < components; ++c) values[to * components + c] = field.components[c][i];
  }
  if (written != particles)
    throw std::invalid_argument(
        fmt::format("field {} covers {} of {} particles", field.name, written, particles));
  return values;
}

} // namespace

std::vector<std::vector<double>> in_original_order(std::span<const Field> fields,
                                                   std::span<const std::int32_t> original,
                                                   std::size_t particles) {
  std::vector<std::vector<double>> values;
  for (const Field& f : fields) values.push_back(in_original_order(f, original, particles));
  return values;
}

} // namespace host
