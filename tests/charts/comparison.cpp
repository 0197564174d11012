// SPDX-License-Identifier: BSD-3-Clause
// Runs the methods over cases and gathers their errors.
#include "tests/charts/element_chart.hpp"
#include "tests/charts/reference.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace charts {
namespace {

enum class End { fine, not_finite, not_converged, drifted };

/// A case on its way through one method.
struct Runner {
  Point point;
  End end = End::fine;
  double error = 0;
};

int material_index(const Case& c, std::size_t materials) {
  return c.sand >= 0 ? c.sand : int(materials) - 1;
}

End judge(const Material& m, const Answer& answer, double tolerance) {
  if (!answer.converged) return End::not_converged;
  const double sum = norm(answer.point.stress) + answer.point.plastic_strain + answer.point.void_ratio;
  if (!std::isfinite(sum) || mean(answer.point.stress) < 0) return End::not_finite;
  const double p = mean(answer.point.stress);
  // A drifted point goes on, as it would in a host: only its case is marked.
  return yield_of(m, answer.point) > tolerance * p ? End::drifted : End::fine;
}

struct Sweep {
  std::vector<Runner> runners;
  long updates = 0;
  double seconds = 0;
};

Sweep sweep(const std::vector<Case>& cases, const std::vector<Target>& targets,
            const std::vector<Material>& materials, const std::vector<std::vector<double>>& props,
            const Method& method) {
  Sweep out;
  for (const auto& c : cases) out.runners.push_back({c.start});
  std::vector<Answer> answers;
  int longest = 0;
  for (const auto& t : targets) longest = std::max(longest, t.updates);
  for (int j = 0; j < longest; ++j)
    for (std::size_t m = 0; m < materials.size(); ++m) {
      Batch batch{&materials[m], props[m], {}, {}};
      std::vector<std::size_t> who;
      for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto& r = out.runners[i];
        const bool stopped = r.end == End::not_finite || r.end == End::not_converged;
        if (!targets[i].found || j >= targets[i].updates || stopped) continue;
        if (material_index(cases[i], materials.size()) != int(m)) continue;
        who.push_back(i);
        batch.old.push_back(r.point);
        batch.strain.push_back(cases[i].strain[j]);
      }
      if (who.empty()) continue;
      out.seconds += method.update(batch, answers);
      out.updates += long(who.size());
      for (std::size_t k = 0; k < who.size(); ++k) {
        auto& r = out.runners[who[k]];
        const End end = judge(materials[m], answers[k], method.yield_tolerance);
        r.point = answers[k].point;
        if (end != End::fine) r.end = end;
      }
    }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double scale =
        std::max({norm(targets[i].stress), norm(cases[i].start.stress), materials.front().given.p_min});
    out.runners[i].error = norm(simsand::add(out.runners[i].point.stress, -1., targets[i].stress)) / scale;
  }
  return out;
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = values.begin() + long(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Row row_of(const std::vector<Runner>& runners, const std::vector<Target>& targets,
           const std::function<bool(std::size_t)>& belongs) {
  Row row{};
  std::vector<double> errors;
  for (std::size_t i = 0; i < runners.size(); ++i) {
    if (!targets[i].found || !belongs(i)) continue;
    ++row.cases;
    row.updates += targets[i].updates;
    row.not_finite += runners[i].end == End::not_finite;
    row.not_converged += runners[i].end == End::not_converged;
    row.drifted += runners[i].end == End::drifted;
    if (runners[i].end == End::not_finite || runners[i].end == End::not_converged) continue;
    errors.push_back(runners[i].error);
    row.over_a_tenth += runners[i].end == End::fine && runners[i].error > 0.1;
  }
  row.error_median = quantile(errors, 0.5);
  row.error_95 = quantile(errors, 0.95);
  row.error_largest = quantile(errors, 1);
  row.nanoseconds = std::numeric_limits<double>::quiet_NaN();
  return row;
}

std::string pressure_name(double pressure) {
  char text[32];
  std::snprintf(text, sizeof text, "%g Pa", pressure);
  return text;
}

} // namespace

std::vector<Target> targets_of(const std::vector<Case>& cases, const std::vector<Material>& materials) {
  std::vector<Target> out(cases.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& c = cases[i];
    const auto& m = materials[material_index(c, materials.size())];
    Reference at{c.start};
    int updates = 0;
    while (at.found && updates < int(c.strain.size())) {
      at = integrate_rates(m, at.point, c.strain[updates++]);
      if (norm(at.point.stress) == 0) break;
    }
    out[i] = {at.point.stress, updates, at.found};
  }
  return out;
}

std::vector<Row> compare(const std::vector<Case>& cases, const std::vector<std::vector<double>>& props,
                         const std::vector<Method>& methods, int repetitions) {
  std::vector<Material> materials;
  for (const auto& p : props) materials.push_back(material_of(p));
  const auto targets = targets_of(cases, materials);
  const bool sampled = cases.front().sand < 0;
  std::set<std::string> paths, densities;
  std::set<double> pressures;
  for (const auto& c : cases) {
    paths.insert(c.path);
    if (!sampled) densities.insert(c.density);
    if (!sampled) pressures.insert(c.pressure);
  }
  std::vector<Row> rows;
  for (const auto& method : methods) {
    auto best = sweep(cases, targets, materials, props, method);
    for (int k = 1; k < repetitions; ++k)
      best.seconds = std::min(best.seconds, sweep(cases, targets, materials, props, method).seconds);
    const auto add = [&](const std::string& group, const std::string& member, auto belongs) {
      Row row = row_of(best.runners, targets, belongs);
      row.method = method.name;
      row.setting = method.setting;
      row.increment = sampled ? 0 : cases.front().increment;
      row.group = group;
      row.member = member;
      if (group == "all") row.nanoseconds = 1e9 * best.seconds / double(best.updates);
      rows.push_back(row);
    };
    add("all", sampled ? "collapse" : "laboratory", [](std::size_t) { return true; });
    for (const auto& name : paths) add("path", name, [&](std::size_t i) { return cases[i].path == name; });
    for (const auto& name : densities)
      add("density", name, [&](std::size_t i) { return cases[i].density == name; });
    for (const double p : pressures)
      add("pressure", pressure_name(p), [&](std::size_t i) { return cases[i].pressure == p; });
  }
  return rows;
}

} // namespace charts
