// SPDX-License-Identifier: BSD-3-Clause
// Markov chain Monte Carlo over a few parameters: an ensemble of walkers whose jumps are built from an archive of
// earlier points. The archive grows during burn-in only; afterwards every walker is a Metropolis-Hastings chain
// with a fixed proposal, so walkers are independent chains given the archive. Method, sources and evidence:
// calibration/SAMPLER.md.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace calibration {

/// Log densities, up to a common constant, of n points given as columns of a (dimensions, n) matrix. Minus infinity
/// excludes a point; NaN and plus infinity are errors. n varies from call to call, from 1 to the number of walkers (at
/// the start: to the number of starting points). It may use threads; the value of a column must not depend on the
/// other columns, on their number or on the threads.
using LogDensity = std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::MatrixXd>& points)>;

struct SamplerOptions {
  int walkers = 32; ///< at least 4; points evaluated at once
  int burn_in =
      1000;         ///< steps of every walker that adapt and are not kept; at least 100 per dimension advised
  int steps = 2000; ///< kept steps of every walker: walkers * steps samples
  int thinning = 1; ///< steps made for every step kept
  std::uint64_t seed = 1; ///< of the random stream
  Eigen::VectorXd lower;  ///< hard bounds, empty or one for each dimension; points beyond are not evaluated
  Eigen::VectorXd upper;
};

/// Where the chain is stored during a run and between runs. Without a file nothing is written.
struct Checkpoint {
  std::filesystem::path file; ///< HDF5, calibration/chain_file.hpp; replaced as a whole, never half written
  double interval = 20;       ///< seconds between two writings
  std::vector<std::string> names; ///< of the dimensions
  std::string
      fingerprint;    ///< of data, priors, fixed parameters, model; must be equal for a run to be resumed
  bool resume = true; ///< continue from the file if it exists; false: an existing file is an error
};

/// The kept samples. Walker w, kept step s.
struct Chain {
  int dimensions = 0, walkers = 0, steps = 0;
  std::vector<double> samples;     ///< (steps, walkers, dimensions), last index fastest
  std::vector<double> log_density; ///< (steps, walkers)
  double acceptance = 0;           ///< part of the proposals of kept steps that were accepted
  bool complete = false;           ///< false if the progress callback stopped the run

  /// All samples as columns, (dimensions, steps * walkers).
  Eigen::Map<const Eigen::MatrixXd> pooled() const {
    return {samples.data(), dimensions, Eigen::Index(steps) * walkers};
  }
  /// One dimension, (steps, walkers): a column is the chain of a walker.
  Eigen::MatrixXd of(int dimension) const {
    return pooled().row(dimension).reshaped(walkers, steps).transpose();
  }
};

struct SamplerProgress {
  double fraction = 0;     ///< of all steps, burn-in included
  double acceptance = 0;   ///< since the last report
  double seconds_left = 0; ///< at the rate of this run
  bool burning_in = false;
};

/// Called about once a second and at the end. Returning false stops the run after its checkpoint is written; a later
/// call resumes it.
using ProgressReport = std::function<bool(const SamplerProgress&)>;

/// Samples the density. `start` holds points as columns (dimensions, m), m at least max(walkers, 2 dimensions + 2),
/// spread wider than the posterior is expected to be: draws from the prior, or around several optima. The first ones of
/// finite density become the walkers; all of finite density begin the archive.
///
/// The result is the same bit for bit for any number of threads and any number of interruptions. A resumed run may have
/// more steps than the file holds, which extends the chain; every other option, the names and the fingerprint must be
/// those of the file.
///
/// Throws std::runtime_error of one line: a density that is NaN or plus infinity (names the point), too few starting
/// points of finite density, starting points in a subspace, a file that is no chain, is damaged or of another problem.
Chain sample(const LogDensity& density, const Eigen::MatrixXd& start, const SamplerOptions& options,
             const Checkpoint& checkpoint = {}, const ProgressReport& report = {});

} // namespace calibration
