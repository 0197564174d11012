// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/chain_image.hpp"
#include "drivers/version.hpp"
#include "host/files/hdf5_write.hpp"
#include "host/files/seal.hpp"

namespace calibration {
namespace {

using host::attribute, host::write_array;

/// A matrix with points as columns, as rows of the dataset.
void points_array(const H5::Group& group, const std::string& name, const Eigen::MatrixXd& points) {
  write_array(group, name, points.data(), {hsize_t(points.cols()), hsize_t(points.rows())});
}

void write_mixture(const H5::Group& group, const StudentMixture& mixture) {
  const hsize_t n = mixture.components.size(), d = mixture.components.front().centre.size();
  std::vector<double> weights, norms, centres, factors;
  for (const auto& c : mixture.components) {
    weights.push_back(c.weight);
    norms.push_back(c.log_norm);
    centres.insert(centres.end(), c.centre.begin(), c.centre.end());
    factors.insert(factors.end(), c.factor.data(), c.factor.data() + c.factor.size());
  }
  write_array(group, "mixture_weights", weights.data(), {n});
  write_array(group, "mixture_norms", norms.data(), {n});
  write_array(group, "mixture_centres", centres.data(), {n, d});
  write_array(group, "mixture_factors", factors.data(), {n, d, d});
}

void write_options(const H5::Group& root, const SamplerOptions& o, const Checkpoint& checkpoint) {
  attribute(root, "walkers", std::int64_t(o.walkers));
  attribute(root, "burn_in", std::int64_t(o.burn_in));
  attribute(root, "thinning", std::int64_t(o.thinning));
  attribute(root, "seed", std::int64_t(o.seed));
  attribute(root, "fingerprint", checkpoint.fingerprint);
  std::string names;
  for (const auto& name : checkpoint.names) names += (names.empty() ? "" : "\n") + name;
  attribute(root, "names", names);
  write_array(root, "lower", o.lower.data(), {hsize_t(o.lower.size())});
  write_array(root, "upper", o.upper.data(), {hsize_t(o.upper.size())});
}

void write_state(const H5::Group& group, const SamplerState& s) {
  attribute(group, "step", std::int64_t(s.step));
  attribute(group, "fitted_first", std::int64_t(s.fitted_first));
  attribute(group, "fitted_count", std::int64_t(s.fitted_count));
  attribute(group, "proposed", std::int64_t(s.proposed));
  attribute(group, "accepted", std::int64_t(s.accepted));
  attribute(group, "independent_proposed", std::int64_t(s.independent_proposed));
  attribute(group, "independent_accepted", std::int64_t(s.independent_accepted));
  points_array(group, "points", s.points);
  write_array(group, "log_density", s.log_density.data(), {hsize_t(s.log_density.size())});
  points_array(group, "archive", s.archive);
  points_array(group, "kernel_archive", s.kernel.archive);
  write_array(group, "kernel_spread", s.kernel.spread.data(), {hsize_t(s.kernel.spread.size())});
  write_array(group, "kernel_weight", s.kernel.weight.data(), {hsize_t(moves)});
  write_mixture(group, s.kernel.mixture);
  write_array(group, "random", s.random.data(), {s.random.size()});
}

void write_chain(const H5::Group& root, const Chain& chain) {
  const hsize_t steps = chain.steps, walkers = chain.walkers, dimensions = chain.dimensions;
  write_array(root, "samples", chain.samples.data(), {steps, walkers, dimensions});
  write_array(root, "log_density", chain.log_density.data(), {steps, walkers});
  attribute(root, "acceptance", chain.acceptance);
  attribute(root, "complete", int(chain.complete));
}

} // namespace

std::string chain_image(const SamplerState& state, const SamplerOptions& options,
                        const Checkpoint& checkpoint) {
  const H5::H5File file = host::memory_file();
  attribute(file, "format", std::string(chain_format_name));
  attribute(file, "format_version", chain_format_version);
  attribute(file, "version", std::string(drivers::version));
  attribute(file, "random_generator", std::string("GSL mt19937"));
  write_options(file, options, checkpoint);
  write_chain(file, state.chain);
  write_state(file.createGroup("state"), state);
  return host::sealed(host::file_image(file));
}

} // namespace calibration
