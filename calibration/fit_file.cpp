// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/fit_file.hpp"
#include "calibration/simulation.hpp"
#include "calibration/test_file.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gsl/gsl_randist.h>
#include <memory>
#include <set>

namespace calibration {
namespace {

using drivers::TomlTable;

/// Bounds of a model error that is an unknown, over the peak of a curve.
constexpr double least_model_error = 1e-4, most_model_error = 1;

void read_material_of(const TomlTable& root, Fit& fit) {
  const auto table = root.table("material");
  if (table.has("properties"))
    table.fail("properties", "SIMSAND: parameters are fitted by their names", "a list of numbers");
  fit.material_source = table.has("file") ? table.path("file") : root.file_name();
  constexpr double any_void_ratio = 0.6; // replaced by that of each test
  fit.material = drivers::read_material(table, any_void_ratio);
  fit.grain_density = fit.material.bulk_density * (1 + fit.material.void_ratio.value_or(any_void_ratio));
}

void read_error(const TomlTable& table, Measure measure, Fit& fit) {
  auto& e = fit.errors[std::size_t(measure)];
  e.declared = true;
  e.absolute = table.number("absolute", {0, 1e12}, 0);
  e.relative = table.number("relative", {0, 1}, 0);
  e.of_peak = table.number("of_peak", {0, 1}, 0);
  e.weight = table.number("weight", {0, 1e6}, 1);
  if (e.absolute == 0 && e.of_peak == 0)
    table.fail("absolute", "absolute or of_peak above 0: a value of 0 has an error too", "neither");
  const auto model = table.number_or_word("model", {0, 1}, {"free"}, drivers::NumberOrWord(0.0));
  if (const auto* number = std::get_if<double>(&model)) {
    e.model = *number;
    return;
  }
  FreeParameter p;
  p.name = fmt::format("model_error_{}", info(measure).key);
  p.measure = measure;
  p.lower = least_model_error;
  p.upper = most_model_error;
  p.logarithmic = true;
  p.prior.kind = Prior::Kind::log_uniform;
  e.free_model = int(fit.unknowns.size());
  fit.unknowns.push_back(p);
}

void read_errors(const TomlTable& root, Fit& fit) {
  const auto table = root.table("error");
  for (std::size_t m = 0; m < measures.size(); ++m)
    if (const auto one = table.optional_table(measures[m].key)) read_error(*one, Measure(m), fit);
  for (const auto& test : fit.tests)
    for (const auto& curve : test.curves)
      if (!fit.errors[std::size_t(curve.measure)].declared)
        table.fail(info(curve.measure).key, fmt::format("a table, as test '{}' compares it", test.name),
                   "no such table");
}

void read_tests(const TomlTable& root, Fit& fit) {
  const auto columns = root.optional_table("columns");
  std::set<std::string> names;
  for (const auto& table : root.tables("test", 1)) {
    fit.tests.push_back(read_test(table, columns));
    if (!names.insert(fit.tests.back().name).second)
      table.fail("name", "a name that no other test has", "\"" + fit.tests.back().name + "\"");
    if (!table.has("file") && !root.has("synthetic"))
      table.fail("file", "a CSV file, as there is no table [synthetic]", "no such key");
  }
  for (const auto& test : fit.tests)
    if (!test.held_out && test.weight > 0) return;
  root.fail("test", "at least one test that is not held out", "none");
}

void read_search(const TomlTable& root, SearchOptions& s) {
  const auto table = root.table_or_empty("search");
  s.starts = int(table.integer("starts", {1, 10000}, s.starts));
  s.candidates = int(table.integer("candidates", {1, 10000}, s.candidates));
  s.iterations = int(table.integer("iterations", {1, 10000}, s.iterations));
  s.seed = std::uint64_t(table.integer("seed", {0, 1e9}, long(s.seed)));
}

void read_sampling(const TomlTable& root, Fit& fit) {
  const auto table = root.optional_table("sampling");
  if (!table) return;
  SamplingOptions s;
  s.walkers = int(table->integer("walkers", {4, 10000}, s.walkers));
  s.burn_in = int(table->integer("burn_in", {1, 1e8}, s.burn_in));
  s.steps = int(table->integer("steps", {4, 1e8}, s.steps));
  s.thinning = int(table->integer("thinning", {1, 1e6}, s.thinning));
  s.seed = std::uint64_t(table->integer("seed", {0, 1e9}, long(s.seed)));
  s.predictive_sets = int(table->integer("predictive_sets", {20, 100000}, s.predictive_sets));
  s.coverage_burn_in = int(table->integer("coverage_burn_in", {1, 1e8}, s.coverage_burn_in));
  s.coverage_steps = int(table->integer("coverage_steps", {8, 1e8}, s.coverage_steps));
  fit.sampling = s;
}

void read_synthetic(const TomlTable& root, Fit& fit) {
  const auto table = root.optional_table("synthetic");
  if (!table) return;
  Synthetic s;
  s.properties = fit.material.material.properties;
  s.noise = table->number("noise", {0, 1e3});
  s.seed = std::uint64_t(table->integer("seed", {0, 1e9}, 1));
  fit.synthetic = s;
  make_curves(fit, s.seed);
}

} // namespace

int Fit::parameters() const {
  return int(std::count_if(unknowns.begin(), unknowns.end(), [](const auto& p) { return p.property >= 0; }));
}

void make_curves(Fit& fit, std::uint64_t seed) {
  Accuracy fine;
  fine.stress /= 10;
  fine.volumetric_strain /= 10;
  const std::unique_ptr<gsl_rng, void (*)(gsl_rng*)> stream(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(stream.get(), seed);
  for (auto& test : fit.tests) {
    Simulator simulator(fit.material, {test.specimen}, fine);
    const auto path = simulator.run(fit.synthetic->properties).front();
    for (auto& curve : test.curves) {
      const auto& e = fit.errors[std::size_t(curve.measure)];
      if (interpolate(path, test.specimen, curve.measure, test.strain, curve.values) < curve.values.size())
        throw std::runtime_error(fmt::format("{}: test '{}': the material fails at a strain of {}",
                                             fit.file_name, test.name, path.axial_strain.back()));
      double peak = 0;
      for (double v : curve.values) peak = std::max(peak, std::abs(v));
      for (double& v : curve.values)
        v += fit.synthetic->noise * gsl_ran_gaussian(stream.get(), 1) *
             std::hypot(e.absolute, e.relative * v, e.of_peak * peak);
    }
  }
}

Fit read_fit(const std::string& path) {
  const auto root = drivers::read_toml(path);
  Fit fit;
  fit.file_name = path;
  fit.title = root.text("title", {}, "");
  read_material_of(root, fit);
  fit.unknowns = read_parameters(root.table("parameter"));
  read_tests(root, fit);
  const auto residual = root.table_or_empty("residual");
  const auto weighting = residual.text("weighting", {"arc", "strain", "rows"}, "arc");
  fit.weighting = weighting == "arc"      ? Weighting::arc
                  : weighting == "strain" ? Weighting::strain
                                          : Weighting::rows;
  fit.estimate_correlation = residual.text("correlation", {"estimated", "none"}, "estimated") == "estimated";
  read_errors(root, fit);
  read_synthetic(root, fit);
  read_search(root, fit.search);
  read_sampling(root, fit);
  const auto output = root.table_or_empty("output");
  const auto stem = std::filesystem::path(path).stem().string();
  fit.output_folder = output.text("folder", {}, "results/fit_" + stem);
  fit.material_name = output.text("material", {}, stem + "_material.toml");
  root.finish();
  fit.resolved = root.resolved();
  return fit;
}

} // namespace calibration
