// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/stored_posterior.hpp"
#include "drivers/files/toml_table.hpp"
#include "host/files/hdf5_read.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gsl/gsl_randist.h>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace calibration {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

drivers::Words split(const std::string& list) {
  drivers::Words words;
  for (std::size_t at = 0; at < list.size();) {
    const auto end = std::min(list.find(',', at), list.size());
    words.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

/// Rows of the first `wanted` columns.
std::vector<std::vector<double>> rows_of(const std::vector<double>& values, std::size_t columns,
                                         std::size_t wanted) {
  std::vector<std::vector<double>> rows;
  for (std::size_t at = 0; at + columns <= values.size(); at += columns)
    rows.emplace_back(values.begin() + std::ptrdiff_t(at), values.begin() + std::ptrdiff_t(at + wanted));
  return rows;
}

/// SIMSAND's keys in the fit's material that were not sampled.
std::map<std::string, double> fixed_keys(const std::string& resolved, const drivers::Words& sampled) {
  const auto material = drivers::parse_toml(resolved, "the fit").table("material");
  std::map<std::string, double> fixed;
  for (const auto& info : simsand::parameters) {
    const std::string key(info.key);
    if (material.has(key) && std::find(sampled.begin(), sampled.end(), key) == sampled.end())
      fixed[key] = material.number(key);
  }
  return fixed;
}

StoredPosterior read(const H5::H5File& h5, const std::filesystem::path& file) {
  if (h5.attrExists("format"))
    fail(file,
         "expected the result of a fit, fit.h5, found its chain, which holds coordinates in place of values");
  if (!h5.attrExists("resolved") || !h5.nameExists("parameters"))
    fail(file, "expected the result of a fit, fit.h5 of simsand calibrate");
  if (!h5.nameExists("posterior"))
    fail(file, "expected a posterior, found a fit without one: its table [sampling] was left out, or "
               "--best-only given");
  StoredPosterior out;
  out.file = file;
  out.names = split(host::text_attribute(h5.openGroup("parameters"), "names"));
  const auto posterior = h5.openGroup("posterior");
  out.converged = host::number_attribute<int>(posterior, "converged") != 0;
  out.samples = rows_of(host::read_array<double>(posterior, "samples"),
                        split(host::text_attribute(posterior, "names")).size(), out.names.size());
  out.fixed = fixed_keys(host::text_attribute(h5, "resolved"), out.names);
  return out;
}

} // namespace

StoredPosterior read_posterior(const std::filesystem::path& file) {
  H5::Exception::dontPrint();
  if (!std::filesystem::is_regular_file(file)) fail(file, "no such file");
  try {
    return read(host::open_to_read(file), file);
  } catch (const H5::Exception& error) {
    fail(file, fmt::format("not a result of simsand calibrate, or damaged ({})", error.getDetailMsg()));
  }
}

void require_fit_for(const host::Scene& scene, const StoredPosterior& posterior) {
  if (scene.friction_angle <= 0)
    fail(posterior.file,
         "expected a scene whose material is SIMSAND, whose parameters were sampled, found another");
  for (const auto& name : posterior.names)
    if (simsand::parameter_index(name) < 0)
      fail(posterior.file, fmt::format("expected parameters of SIMSAND, found '{}'", name));
  for (const auto& [key, value] : posterior.fixed) {
    const double here = scene.material.properties[std::size_t(simsand::parameter_index(key))];
    if (key != "e0" && std::abs(here - value) > 1e-9 * std::max(std::abs(here), std::abs(value)))
      fail(posterior.file,
           fmt::format("its samples hold for {} = {:g}, which the fit kept fixed, and the scene has {:g}; "
                       "give the scene the material of the fit, or --set material.{}={:g}",
                       key, value, here, key, value));
  }
}

std::vector<std::size_t> draw_rows(const StoredPosterior& posterior, int count, std::uint64_t seed) {
  if (std::size_t(count) > posterior.samples.size())
    fail(posterior.file,
         fmt::format("expected at least {} samples, found {}", count, posterior.samples.size()));
  const std::unique_ptr<gsl_rng, void (*)(gsl_rng*)> stream(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(stream.get(), seed);
  std::vector<std::size_t> all(posterior.samples.size()), drawn(std::size_t(count), 0);
  std::iota(all.begin(), all.end(), std::size_t(0));
  gsl_ran_choose(stream.get(), drawn.data(), drawn.size(), all.data(), all.size(), sizeof(std::size_t));
  return drawn;
}

} // namespace calibration
