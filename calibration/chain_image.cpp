// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/chain_image.hpp"
#include "drivers/version.hpp"
#include "host/files/hdf5_write.hpp"
#include <algorithm>

namespace calibration {
namespace {

constexpr hsize_t chunk_length = 65536; ///< values, 512 KiB of doubles

using Shape = std::vector<hsize_t>;

/// An array whose first extent may be long.
void array(const H5::Group& group, const std::string& name, const H5::PredType& type, const void* values,
           const Shape& shape) {
  Shape chunk = shape;
  hsize_t size = 1, row = 1;
  for (std::size_t i = 0; i < shape.size(); ++i) size *= shape[i], row *= i > 0 ? shape[i] : 1;
  H5::DSetCreatPropList properties;
  if (size > 0) {
    chunk[0] = std::clamp<hsize_t>(chunk_length / row, 1, shape[0]);
    properties.setChunk(int(shape.size()), chunk.data());
    properties.setFletcher32();
  }
  const auto dataset =
      group.createDataSet(name, type, H5::DataSpace(int(shape.size()), shape.data()), properties);
  if (size > 0) dataset.write(values, type);
}

void real_array(const H5::Group& group, const std::string& name, const double* values, const Shape& shape) {
  array(group, name, H5::PredType::NATIVE_DOUBLE, values, shape);
}

/// A matrix with points as columns, as rows of the dataset.
void points_array(const H5::Group& group, const std::string& name, const Eigen::MatrixXd& points) {
  real_array(group, name, points.data(), {hsize_t(points.cols()), hsize_t(points.rows())});
}

void counter(const H5::Group& group, const std::string& name, std::int64_t value) {
  group.createAttribute(name, H5::PredType::NATIVE_INT64, H5::DataSpace(H5S_SCALAR))
      .write(H5::PredType::NATIVE_INT64, &value);
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
  real_array(group, "mixture_weights", weights.data(), {n});
  real_array(group, "mixture_norms", norms.data(), {n});
  real_array(group, "mixture_centres", centres.data(), {n, d});
  real_array(group, "mixture_factors", factors.data(), {n, d, d});
}

void write_options(const H5::Group& root, const SamplerOptions& o, const Checkpoint& checkpoint) {
  counter(root, "walkers", o.walkers);
  counter(root, "burn_in", o.burn_in);
  counter(root, "thinning", o.thinning);
  counter(root, "seed", std::int64_t(o.seed));
  host::attribute(root, "fingerprint", checkpoint.fingerprint);
  std::string names;
  for (const auto& name : checkpoint.names) names += (names.empty() ? "" : "\n") + name;
  host::attribute(root, "names", names);
  real_array(root, "lower", o.lower.data(), {hsize_t(o.lower.size())});
  real_array(root, "upper", o.upper.data(), {hsize_t(o.upper.size())});
}

void write_state(const H5::Group& group, const SamplerState& s) {
  counter(group, "step", s.step);
  counter(group, "fitted_first", s.fitted_first);
  counter(group, "fitted_count", s.fitted_count);
  counter(group, "proposed", s.proposed);
  counter(group, "accepted", s.accepted);
  counter(group, "independent_proposed", s.independent_proposed);
  counter(group, "independent_accepted", s.independent_accepted);
  points_array(group, "points", s.points);
  real_array(group, "log_density", s.log_density.data(), {hsize_t(s.log_density.size())});
  points_array(group, "archive", s.archive);
  points_array(group, "kernel_archive", s.kernel.archive);
  real_array(group, "kernel_spread", s.kernel.spread.data(), {hsize_t(s.kernel.spread.size())});
  real_array(group, "kernel_weight", s.kernel.weight.data(), {hsize_t(moves)});
  write_mixture(group, s.kernel.mixture);
  array(group, "random", H5::PredType::NATIVE_UCHAR, s.random.data(), {s.random.size()});
}

void write_chain(const H5::Group& root, const Chain& chain) {
  const hsize_t steps = chain.steps, walkers = chain.walkers, dimensions = chain.dimensions;
  real_array(root, "samples", chain.samples.data(), {steps, walkers, dimensions});
  real_array(root, "log_density", chain.log_density.data(), {steps, walkers});
  host::attribute(root, "acceptance", chain.acceptance);
  host::attribute(root, "complete", int(chain.complete));
}

} // namespace

std::string chain_image(const SamplerState& state, const SamplerOptions& options,
                        const Checkpoint& checkpoint) {
  const H5::H5File file = host::memory_file();
  host::attribute(file, "format", std::string(chain_format_name));
  host::attribute(file, "format_version", chain_format_version);
  host::attribute(file, "version", std::string(drivers::version));
  host::attribute(file, "random_generator", std::string("GSL mt19937"));
  write_options(file, options, checkpoint);
  write_chain(file, state.chain);
  write_state(file.createGroup("state"), state);
  return host::file_image(file);
}

} // namespace calibration
