// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/chain_file.hpp"
#include "calibration/chain_image.hpp"
#include "host/files/hdf5_read.hpp"
#include "host/files/seal.hpp"
#include "host/files/whole_file.hpp"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace calibration {
namespace {

using host::extents_of, host::Extents, host::number_attribute, host::read_array, host::text_attribute;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

/// Reads arrays whose extents are known from attributes.
struct Reader {
  const std::filesystem::path& path;

  template <typename Value>
  std::vector<Value> array(const H5::Group& group, const std::string& name, const Extents& expected) const {
    if (extents_of(group, name) != expected)
      fail(path, fmt::format("damaged chain: extents of {} differ from what its attributes say", name));
    return read_array<Value>(group, name);
  }
  std::vector<double> reals(const H5::Group& group, const std::string& name, const Extents& expected) const {
    return array<double>(group, name, expected);
  }
  Eigen::MatrixXd points(const H5::Group& group, const std::string& name, hsize_t dimensions) const {
    const auto extents = extents_of(group, name);
    const hsize_t count = extents.empty() ? 0 : extents[0];
    const auto values = reals(group, name, {count, dimensions});
    return Eigen::Map<const Eigen::MatrixXd>(values.data(), Eigen::Index(dimensions), Eigen::Index(count));
  }
  Eigen::VectorXd vector(const H5::Group& group, const std::string& name, hsize_t size) const {
    const auto values = reals(group, name, {size});
    return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(size));
  }
};

std::int64_t counter(const H5::H5Object& object, const std::string& name) {
  return number_attribute<std::int64_t>(object, name);
}

/// Runs `read` if the checksum of the file fits, and turns HDF5's exceptions into one line.
template <typename Read> auto guarded_read(const std::filesystem::path& path, const Read& read) {
  const host::QuietDestructors quiet;
  H5::Exception::dontPrint();
  if (host::has_intact_seal(path)) try {
      return read();
    } catch (const H5::Exception&) {}
  fail(path, "not a chain of this program, or damaged; the file is left as it is. Name another file or "
             "delete this one");
}

H5::H5File open_chain(const std::filesystem::path& path) {
  const auto file = host::open_to_read(path);
  if (!file.attrExists("format") || text_attribute(file, "format") != chain_format_name)
    fail(path, "not a chain of this program; the file is left as it is");
  if (const auto version = counter(file, "format_version"); version != chain_format_version)
    fail(path, fmt::format("format {} of the chain, this program reads {}", version, chain_format_version));
  return file;
}

std::vector<std::string> read_names(const H5::H5File& file) {
  std::vector<std::string> names;
  const std::string text = text_attribute(file, "names");
  for (std::size_t first = 0; first < text.size();) {
    const auto last = std::min(text.find('\n', first), text.size());
    names.push_back(text.substr(first, last - first));
    first = last + 1;
  }
  return names;
}

Chain read_samples(const H5::H5File& file, const Reader& reader) {
  const Extents extents = extents_of(file, "samples");
  if (extents.size() != 3) fail(reader.path, "damaged chain: samples must have three extents");
  Chain chain;
  chain.steps = int(extents[0]);
  chain.walkers = int(extents[1]);
  chain.dimensions = int(extents[2]);
  chain.samples = reader.reals(file, "samples", extents);
  chain.log_density = reader.reals(file, "log_density", {extents[0], extents[1]});
  chain.acceptance = number_attribute<double>(file, "acceptance");
  chain.complete = counter(file, "complete") != 0;
  return chain;
}

StudentMixture read_mixture(const H5::Group& group, const Reader& reader, hsize_t d) {
  const Extents extents = extents_of(group, "mixture_weights");
  const hsize_t n = extents.empty() ? 0 : extents[0];
  const auto weights = reader.reals(group, "mixture_weights", {n}),
             norms = reader.reals(group, "mixture_norms", {n});
  const auto centres = reader.reals(group, "mixture_centres", {n, d});
  const auto factors = reader.reals(group, "mixture_factors", {n, d, d});
  StudentMixture mixture;
  for (hsize_t k = 0; k < n; ++k) {
    const auto extent = Eigen::Index(d);
    mixture.components.push_back(
        {weights[k], norms[k], Eigen::Map<const Eigen::VectorXd>(centres.data() + k * d, extent),
         Eigen::Map<const Eigen::MatrixXd>(factors.data() + k * d * d, extent, extent)});
  }
  return mixture;
}

SamplerState read_state(const H5::Group& group, const Reader& reader, hsize_t dimensions, hsize_t walkers) {
  SamplerState s;
  s.step = counter(group, "step");
  s.fitted_first = counter(group, "fitted_first");
  s.fitted_count = counter(group, "fitted_count");
  s.proposed = counter(group, "proposed");
  s.accepted = counter(group, "accepted");
  s.independent_proposed = counter(group, "independent_proposed");
  s.independent_accepted = counter(group, "independent_accepted");
  s.points = reader.points(group, "points", dimensions);
  s.log_density = reader.vector(group, "log_density", walkers);
  s.archive = reader.points(group, "archive", dimensions);
  s.kernel.archive = reader.points(group, "kernel_archive", dimensions);
  s.kernel.spread = reader.vector(group, "kernel_spread", dimensions);
  const auto weight = reader.reals(group, "kernel_weight", {hsize_t(moves)});
  std::copy(weight.begin(), weight.end(), s.kernel.weight.begin());
  s.kernel.mixture = read_mixture(group, reader, dimensions);
  s.random = read_array<unsigned char>(group, "random");
  return s;
}

void require_same(const H5::H5File& file, const Reader& reader, const SamplerOptions& o, const Checkpoint& c,
                  const Chain& chain, int dimensions) {
  const auto differ = [&](const std::string& what, const auto& stored, const auto& asked) {
    if (stored != asked)
      fail(reader.path,
           fmt::format("the chain is of another run: {} is {} there and {} here; name another file "
                       "to start anew",
                       what, stored, asked));
  };
  differ("fingerprint of the problem", text_attribute(file, "fingerprint"), c.fingerprint);
  differ("number of dimensions", chain.dimensions, dimensions);
  if (read_names(file) != c.names) fail(reader.path, "the chain is of other parameters; name another file");
  differ("walkers", counter(file, "walkers"), std::int64_t(o.walkers));
  differ("burn_in", counter(file, "burn_in"), std::int64_t(o.burn_in));
  differ("thinning", counter(file, "thinning"), std::int64_t(o.thinning));
  differ("seed", std::uint64_t(counter(file, "seed")), o.seed);
  for (const auto& [name, bound] : {std::pair("lower", &o.lower), std::pair("upper", &o.upper)})
    if (extents_of(file, name) != Extents{hsize_t(bound->size())} ||
        reader.vector(file, name, hsize_t(bound->size())) != *bound)
      fail(reader.path, fmt::format("the chain is of another run: other {} bounds; name another file", name));
  if (chain.steps > o.steps)
    fail(reader.path,
         fmt::format("the chain has {} steps, more than the {} asked for", chain.steps, o.steps));
}

} // namespace

ChainFile::ChainFile(Checkpoint where, SamplerOptions how)
    : checkpoint(std::move(where)), options(std::move(how)), lock_path(checkpoint.file.string() + ".lock") {
  std::error_code error;
  if (checkpoint.file.has_parent_path())
    std::filesystem::create_directories(checkpoint.file.parent_path(), error);
  if (error) fail(checkpoint.file, fmt::format("cannot create its folder ({})", error.message()));
  lock = ::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock < 0) fail(checkpoint.file, fmt::format("cannot write beside it ({})", std::strerror(errno)));
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock);
    fail(checkpoint.file, "another run is writing this file");
  }
  if (!checkpoint.resume && exists()) {
    ::close(lock);
    fail(checkpoint.file, "exists already");
  }
}

ChainFile::~ChainFile() {
  ::close(lock); // the empty file stays: removing it could take the lock from a run that has just opened it
}

bool ChainFile::exists() const {
  return std::filesystem::exists(checkpoint.file);
}

SamplerState ChainFile::read(int dimensions) const {
  const Reader reader{checkpoint.file};
  return guarded_read(checkpoint.file, [&] {
    const H5::H5File file = open_chain(checkpoint.file);
    Chain chain = read_samples(file, reader);
    require_same(file, reader, options, checkpoint, chain, dimensions);
    SamplerState state =
        read_state(file.openGroup("state"), reader, hsize_t(chain.dimensions), hsize_t(chain.walkers));
    state.chain = std::move(chain);
    return state;
  });
}

void ChainFile::write(const SamplerState& state) const {
  std::string image;
  H5::Exception::dontPrint();
  host::guarded_write(checkpoint.file, "the chain", [&] { image = chain_image(state, options, checkpoint); });
  try {
    host::write_whole(checkpoint.file, image);
  } catch (const std::system_error& error) {
    fail(checkpoint.file,
         fmt::format("cannot write the chain ({}); the state before is kept", error.code().message()));
  }
}

StoredChain read_chain(const std::filesystem::path& path) {
  const Reader reader{path};
  return guarded_read(path, [&] {
    const H5::H5File file = open_chain(path);
    return StoredChain{read_samples(file, reader), read_names(file), text_attribute(file, "fingerprint")};
  });
}

} // namespace calibration
