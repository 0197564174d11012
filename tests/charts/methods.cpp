// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/methods.hpp"
#include "tests/charts/material_library.hpp"
#include <ctime>
#include <fmt/format.h>
#include <stdexcept>

namespace charts {
namespace {

using PointUpdate = std::function<Answer(const Material&, const Point&, const Tensor&)>;

/// The updates of a batch one after another, each in equal parts.
Method point_by_point(std::string name, std::string setting, PointUpdate update, int parts) {
  return {std::move(name), std::move(setting), 1e-6,
          [update = std::move(update), parts](const Batch& batch, std::vector<Answer>& answers) {
            answers.resize(batch.old.size());
            const double start = thread_seconds();
            for (std::size_t i = 0; i < batch.old.size(); ++i) {
              Answer answer{batch.old[i]};
              const auto part = simsand::scale(1. / parts, batch.strain[i]);
              for (int k = 0; k < parts && answer.converged; ++k)
                answer = update(*batch.material, answer.point, part);
              answers[i] = answer;
            }
            return thread_seconds() - start;
          }};
}

Answer product_point(const Material& m, const Point& old, const Tensor& strain) {
  const auto out = simsand::update(m, old, strain);
  return {out.state, int(out.status) >= 0};
}

/// The product's library in blocks of 128; a block that is not full repeats its last point, which is not counted.
template <class Real>
double call_in_blocks(vumat::Subroutine<Real>* library, int parts, const Batch& batch,
                      std::vector<Answer>& answers) {
  answers.resize(batch.old.size());
  const std::vector<Real> props(batch.props.begin(), batch.props.end());
  double seconds = 0;
  for (std::size_t first = 0; first < batch.old.size(); first += vumat::max_block) {
    const int count = int(std::min<std::size_t>(vumat::max_block, batch.old.size() - first));
    LibraryBlock<Real> block(count);
    for (int k = 0; k < count; ++k)
      block.put(k, batch.old[first + k], simsand::scale(1. / parts, batch.strain[first + k]));
    for (int part = 0; part < parts; ++part) {
      if (part) block.advance();
      const double start = thread_seconds();
      block.call(library, props);
      seconds += thread_seconds() - start;
    }
    for (int k = 0; k < count; ++k) answers[first + k] = {block.get(k), block.status(k) >= 0};
  }
  return seconds;
}

template <class Real> Method in_blocks(std::string name, std::string setting, double tolerance, int parts) {
  auto* library = material_library<Real>();
  return {std::move(name), std::move(setting), tolerance,
          [library, parts](const Batch& batch, std::vector<Answer>& answers) {
            return call_in_blocks<Real>(library, parts, batch, answers);
          }};
}

} // namespace

double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::vector<Method> all_methods() {
  std::vector<Method> all;
  for (const int parts : {1, 2, 4, 8, 16, 32}) {
    const auto setting = fmt::format("parts={}", parts);
    all.push_back(point_by_point("explicit Euler", setting, explicit_euler, parts));
    all.push_back(point_by_point("corrected Euler", setting, corrected_euler, parts));
    all.push_back(point_by_point("backward Euler", setting, backward_euler, parts));
    all.push_back(point_by_point("cutting plane", setting, cutting_plane, parts));
    all.push_back(point_by_point("product, one point", setting, product_point, parts));
    // Roundings of a stress near its isotropic part: about 30 in single precision.
    all.push_back(in_blocks<double>("product, blocks", setting, 1e-6, parts));
    all.push_back(in_blocks<float>("product, blocks, single", setting, 1e-5, parts));
  }
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
    all.push_back(point_by_point(
        "modified Euler", fmt::format("tolerance={:g}", tolerance),
        [tolerance](const Material& m, const Point& old, const Tensor& strain) {
          return modified_euler(m, old, strain, tolerance);
        },
        1));
  return all;
}

const Method& method_named(const std::vector<Method>& methods, const std::string& name,
                           const std::string& setting) {
  for (const auto& method : methods)
    if (method.name == name && method.setting == setting) return method;
  throw std::runtime_error(fmt::format("no method '{}' with '{}'", name, setting));
}

} // namespace charts
