// SPDX-License-Identifier: BSD-3-Clause
// The result of a fit in files for programs: TOML, a material file, HDF5. Layout: README.md.
#include "calibration/report.hpp"
#include "host/files/hdf5_write.hpp"
#include "vumat/parameters.hpp"
#include <cmath>
#include <fmt/format.h>

namespace calibration {
namespace {

using drivers::quoted_text;
using drivers::toml_number;

std::vector<double> row_major(const Eigen::MatrixXd& m) {
  std::vector<double> out;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) out.push_back(m(i, j));
  return out;
}

std::string name_list(const Fit& fit, std::size_t count) {
  std::string out;
  for (std::size_t d = 0; d < count; ++d) out += (d ? "," : "") + fit.unknowns[d].name;
  return out;
}

std::string numbers(const Eigen::VectorXd& v) {
  return drivers::written(std::vector<double>(v.begin(), v.end()));
}

void write_curves(const Result& r, H5::H5File& file) {
  auto curves = file.createGroup("curves");
  const auto best = r.objective.predict(r.fit.best.end), material = r.objective.predict(at_material(r));
  for (std::size_t k = 0; k < r.objective.curves.size(); ++k) {
    const auto& c = r.objective.curves[k];
    const auto& test = r.objective.fit.tests[c.test];
    auto group = curves.createGroup(fmt::format("{:03}", k));
    const std::string unit(info(c.measure).unit);
    host::attribute(group, "test", test.name);
    host::attribute(group, "measure", std::string(info(c.measure).key));
    host::attribute(group, "kind", std::string(test.specimen.kind->name));
    host::attribute(group, "held_out", int(test.held_out));
    host::attribute(group, "independent_rows", c.independent_rows);
    host::attribute(group, "confining_stress_Pa", test.specimen.radial_stress);
    host::attribute(group, "void_ratio", test.specimen.void_ratio);
    host::attribute(group, "model_error", r.objective.model_error(c, r.fit.best.end));
    host::write_dataset(group, "axial_strain", "-", test.strain);
    host::write_dataset(group, "measured", unit, c.measured);
    host::write_dataset(group, "error", unit, c.error);
    host::write_dataset(group, "share", "-", c.share);
    host::write_dataset(group, "best", unit, best[k]);
    host::write_dataset(group, "material", unit, material[k]);
    if (!r.posterior || r.posterior->bands.empty() || r.posterior->bands[k].lower.empty()) continue;
    const auto& band = r.posterior->bands[k];
    host::attribute(group, "coverage", band.coverage);
    host::write_dataset(group, "model_lower", unit, band.model_lower);
    host::write_dataset(group, "model_median", unit, band.model_median);
    host::write_dataset(group, "model_upper", unit, band.model_upper);
    host::write_dataset(group, "lower", unit, band.lower);
    host::write_dataset(group, "upper", unit, band.upper);
  }
}

void write_parameters(const Result& r, H5::H5File& file) {
  const auto& fit = r.objective.fit;
  const int d = fit.parameters();
  auto group = file.createGroup("parameters");
  host::attribute(group, "names", name_list(fit, d));
  std::vector<double> best, lower, upper, logarithmic, reference, start;
  for (int k = 0; k < d; ++k) {
    const auto& p = fit.unknowns[k];
    best.push_back(p.value(r.fit.best.end[k]));
    start.push_back(p.value(r.fit.best.start[k]));
    lower.push_back(p.lower);
    upper.push_back(p.upper);
    logarithmic.push_back(p.logarithmic);
    reference.push_back(fit.material.material.properties[p.property]);
  }
  host::write_dataset(group, "best", "own", best);
  host::write_dataset(group, "start", "own", start);
  host::write_dataset(group, "lower", "own", lower);
  host::write_dataset(group, "upper", "own", upper);
  host::write_dataset(group, "logarithmic", "-", logarithmic);
  host::write_dataset(group, "material", "own", reference);
  host::write_dataset(group, "covariance", "coordinates", row_major(r.identifiability.covariance), d);
  host::write_dataset(group, "correlation", "-", row_major(r.identifiability.correlation), d);
  std::vector<double> singular, weights;
  for (const auto& c : r.identifiability.combinations) {
    singular.push_back(c.singular_value);
    weights.insert(weights.end(), c.weights.begin(), c.weights.end());
  }
  host::write_dataset(group, "singular_values", "-", singular);
  host::write_dataset(group, "combinations", "-", weights, d);
}

void write_posterior(const Result& r, H5::H5File& file) {
  auto group = file.createGroup("posterior");
  const auto& post = *r.posterior;
  host::attribute(group, "names", name_list(r.objective.fit, r.objective.fit.unknowns.size()));
  host::attribute(group, "walkers", post.chain.walkers);
  host::attribute(group, "converged", int(post.diagnosis.verdict.converged));
  // (steps * walkers, unknowns), values; rows of one step are next to each other.
  host::write_dataset(group, "samples", "own", row_major(post.values.transpose()), int(post.values.rows()));
  host::write_dataset(group, "log_density", "-", post.chain.log_density);
}

} // namespace

std::string report_toml(const Result& r) {
  const auto& fit = r.objective.fit;
  std::string out =
      fmt::format("fit = {}\ncommand = {}\nchi_squared = {}\ndegrees_of_freedom = {}\nsimulations = {}\n"
                  "failed_simulations = {}\nseconds = {}\nwarnings = {}\n",
                  quoted_text(fit.file_name), quoted_text(r.command), toml_number(r.fit.chi_squared),
                  toml_number(r.fit.degrees), r.objective.simulations(), r.objective.failures(),
                  toml_number(r.seconds), drivers::written(warnings(r)));
  for (int d = 0; d < fit.parameters(); ++d) {
    const auto& p = fit.unknowns[d];
    out += fmt::format("\n[[parameter]]\nname = {}\nbest = {}\nstart = {}\nmaterial = {}\nlower_bound = "
                       "{}\nupper_bound = {}\n"
                       "deviation_over_range = {}\nfinding = {}\n",
                       quoted_text(p.name), toml_number(p.value(r.fit.best.end[d])),
                       toml_number(p.value(r.fit.best.start[d])),
                       toml_number(fit.material.material.properties[p.property]), toml_number(p.lower),
                       toml_number(p.upper), toml_number(r.identifiability.deviation[d]),
                       quoted_text(describe(r.identifiability.findings[d])));
    out += fmt::format("correlation = {}\n", numbers(r.identifiability.correlation.row(d)));
    if (!r.posterior || r.posterior->diagnosis.marginals.empty()) continue;
    const auto& m = r.posterior->diagnosis.marginals[d];
    out += fmt::format("posterior = {{mean = {}, deviation = {}, lower_90 = {}, upper_90 = {}, rhat = {}, "
                       "effective_size = {}}}\n",
                       toml_number(m.mean), toml_number(m.deviation), toml_number(m.equal_tailed.lower),
                       toml_number(m.equal_tailed.upper), toml_number(m.rhat), toml_number(m.bulk_size));
  }
  for (std::size_t d = fit.parameters(); d < fit.unknowns.size(); ++d)
    out += fmt::format("\n[[model_error]]\nname = {}\nof_peak = {}\n", quoted_text(fit.unknowns[d].name),
                       toml_number(fit.unknowns[d].value(r.fit.best.end[d])));
  for (const auto& c : r.identifiability.combinations)
    out += fmt::format(
        "\n[[combination]]\nsingular_value = {}\ndeviation = {}\ndetermined = {}\nweights = {}\n",
        toml_number(c.singular_value), toml_number(c.deviation), c.determined, numbers(c.weights));
  const auto all = misfits(r.objective, r.fit.best.end), material = misfits(r.objective, at_material(r));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& c = r.objective.curves[k];
    out += fmt::format(
        "\n[[curve]]\ntest = {}\nmeasure = {}\nheld_out = {}\nrows = {}\nindependent_rows = {}\nrms = {}\n"
        "rms_over_peak = {}\nrms_over_peak_of_material = {}\nrms_over_error = {}\n",
        quoted_text(fit.tests[c.test].name), quoted_text(info(c.measure).key), k >= r.objective.fitted_curves,
        c.measured.size(), toml_number(c.independent_rows), toml_number(all[k].rms),
        toml_number(all[k].of_peak), toml_number(material[k].of_peak), toml_number(all[k].in_errors));
    if (r.posterior && !r.posterior->bands.empty())
      out += fmt::format("in_90_percent_band = {}\n", toml_number(r.posterior->bands[k].coverage));
  }
  return out;
}

std::string material_toml(const Result& r) {
  const auto& fit = r.objective.fit;
  std::string out =
      fmt::format("# SPDX-License-Identifier: BSD-3-Clause\n# SIMSAND parameters. {}\n# Made by: {}\n"
                  "# Others are those of {}.\n",
                  fit.title, r.command, std::filesystem::path(fit.material_source).filename().string());
  for (const auto& line : warnings(r)) out += "# Warning: " + line + "\n";
  out += "name = \"SIMSAND\"\n\n";
  const auto props = r.objective.properties(r.fit.best.end);
  for (std::size_t i = 0; i < simsand::parameters.size(); ++i) {
    const auto& parameter = simsand::parameters[i];
    if (parameter.key == "e0") continue; // scenes and paths give it
    std::string remark;
    for (int d = 0; d < fit.parameters(); ++d) {
      if (fit.unknowns[d].property != int(i)) continue;
      remark = fmt::format("  # {}", describe(r.identifiability.findings[d]));
      if (r.posterior && !r.posterior->diagnosis.marginals.empty()) {
        const auto& m = r.posterior->diagnosis.marginals[d];
        remark += fmt::format("; 90 %: {:.4g} to {:.4g}", m.equal_tailed.lower, m.equal_tailed.upper);
      }
    }
    const bool fitted = !remark.empty();
    out += fmt::format("{} = {}{}\n", parameter.key,
                       toml_number(fitted ? std::stod(fmt::format("{:.6g}", props[i])) : props[i]), remark);
  }
  return out + fmt::format("grain_density = {}\n",
                           toml_number(std::stod(fmt::format("{:.10g}", fit.grain_density))));
}

void write_hdf5(const Result& r, const std::filesystem::path& path) {
  host::require_writable(path);
  host::guarded_write(path, "the fit", [&] {
    H5::H5File file(path.string(), H5F_ACC_TRUNC);
    host::attribute(file, "title", r.objective.fit.title);
    host::attribute(file, "command", r.command);
    host::attribute(file, "resolved", r.objective.fit.resolved);
    host::attribute(file, "report", report_text(r));
    write_parameters(r, file);
    write_curves(r, file);
    if (r.posterior) write_posterior(r, file);
  });
}

} // namespace calibration
