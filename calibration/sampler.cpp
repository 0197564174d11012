// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/sampler.hpp"
#include "calibration/chain_file.hpp"
#include "calibration/sampler_state.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <stdexcept>

namespace calibration {
namespace {

constexpr double growth = 1.5;      ///< of the archive between two fits of the kernel
constexpr int archive_visits = 500; ///< largest number of points of each walker that enter the archive

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

Eigen::VectorXd evaluate(const LogDensity& density, const Eigen::MatrixXd& points) {
  if (points.cols() == 0) return {};
  Eigen::VectorXd values = density(points);
  if (values.size() != points.cols())
    throw std::runtime_error(
        fmt::format("log density of {} points has {} values", points.cols(), values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (std::isnan(values(i)) || values(i) == INFINITY)
      throw std::runtime_error(fmt::format("log density is {} at ({:.17g})", values(i),
                                           fmt::join(points.col(i).begin(), points.col(i).end(), ", ")));
  return values;
}

bool within(const SamplerOptions& options, const Eigen::Ref<const Eigen::VectorXd>& point) {
  return point.allFinite() && (options.lower.size() == 0 || (point.array() >= options.lower.array()).all()) &&
         (options.upper.size() == 0 || (point.array() <= options.upper.array()).all());
}

void check(const SamplerOptions& o, const Eigen::MatrixXd& start) {
  const auto wrong = [](const std::string& what) { throw std::runtime_error("sampler: " + what); };
  if (o.walkers < 4) wrong(fmt::format("walkers = {}, at least 4 expected", o.walkers));
  if (o.burn_in < 20) wrong(fmt::format("burn_in = {}, at least 20 expected", o.burn_in));
  if (o.steps < 1) wrong(fmt::format("steps = {}, at least 1 expected", o.steps));
  if (o.thinning < 1) wrong(fmt::format("thinning = {}, at least 1 expected", o.thinning));
  if (start.rows() < 1) wrong("no dimensions");
  for (const auto* bound : {&o.lower, &o.upper})
    if (bound->size() != 0 && bound->size() != start.rows())
      wrong(fmt::format("{} bounds for {} dimensions", bound->size(), start.rows()));
}

/// Fits the proposals to the last third of the archive, as earlier points still depend on the start.
void fit(SamplerState& state, RandomStream& random) {
  const auto points = state.archive.cols();
  state.fitted_first = state.step == 0 ? 0 : 2 * points / 3;
  state.fitted_count = points - state.fitted_first;
  const double accepted =
      double(state.independent_accepted) / double(std::max<std::int64_t>(1, state.independent_proposed));
  state.kernel = fit_kernel(state.archive.middleCols(state.fitted_first, state.fitted_count),
                            move_weights(accepted), random);
  state.independent_proposed = state.independent_accepted = 0;
}

SamplerState begin(const LogDensity& density, const Eigen::MatrixXd& start, const SamplerOptions& options,
                   RandomStream& random) {
  std::vector<Eigen::Index> inside, finite;
  for (Eigen::Index i = 0; i < start.cols(); ++i)
    if (within(options, start.col(i))) inside.push_back(i);
  const Eigen::MatrixXd allowed = start(Eigen::all, inside);
  const Eigen::VectorXd values = evaluate(density, allowed);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (std::isfinite(values(i))) finite.push_back(i);
  const auto needed = std::max<std::size_t>(options.walkers, 2 * start.rows() + 2);
  if (finite.size() < needed)
    throw std::runtime_error(
        fmt::format("sampler: {} of {} starting points are within the bounds and have a finite "
                    "density, at least {} expected",
                    finite.size(), start.cols(), needed));
  SamplerState state;
  state.archive = allowed(Eigen::all, finite);
  state.points = state.archive.leftCols(options.walkers);
  state.log_density = values(finite).head(options.walkers);
  state.chain.dimensions = int(start.rows());
  state.chain.walkers = options.walkers;
  fit(state, random);
  return state;
}

void move_walkers(SamplerState& state, const LogDensity& density, const SamplerOptions& options,
                  RandomStream& random) {
  std::vector<Proposal> proposals;
  std::vector<double> threshold; ///< smallest log density that is accepted, less the walker's
  std::vector<int> tried;        ///< walkers whose proposal is evaluated
  Eigen::MatrixXd points(state.points.rows(), options.walkers);
  for (int w = 0; w < options.walkers; ++w) {
    proposals.push_back(propose(state.kernel, state.points.col(w), random));
    const auto& p = proposals.back();
    threshold.push_back(std::log(random.uniform()) - p.log_ratio);
    state.independent_proposed += p.move == Move::independent;
    if (!within(options, p.point) || !std::isfinite(p.log_ratio)) continue;
    points.col(Eigen::Index(tried.size())) = p.point;
    tried.push_back(w);
  }
  const Eigen::VectorXd values = evaluate(density, points.leftCols(Eigen::Index(tried.size())));
  state.proposed += options.walkers;
  for (std::size_t k = 0; k < tried.size(); ++k) {
    const int w = tried[k];
    if (!(values(Eigen::Index(k)) - state.log_density(w) > threshold[w])) continue;
    state.points.col(w) = proposals[w].point;
    state.log_density(w) = values(Eigen::Index(k));
    ++state.accepted;
    state.independent_accepted += proposals[w].move == Move::independent;
  }
}

/// Extends the archive in a step of the burn-in and fits the proposals to it. They stay as they are after the last step.
void adapt(SamplerState& state, const SamplerOptions& options, RandomStream& random) {
  const int every = 1 + (options.burn_in - 1) / archive_visits;
  if (state.step % every == 0) {
    const auto before = state.archive.cols();
    state.archive.conservativeResize(Eigen::NoChange, before + options.walkers);
    state.archive.rightCols(options.walkers) = state.points;
  }
  const bool last = state.step == options.burn_in;
  const double at_last_fit = double(state.fitted_first + state.fitted_count);
  if (last || double(state.archive.cols()) > growth * at_last_fit) fit(state, random);
  if (!last) return;
  state.archive.resize(Eigen::NoChange, 0);
  state.proposed = state.accepted = 0;
}

void keep_step(SamplerState& state) {
  auto& chain = state.chain;
  chain.samples.insert(chain.samples.end(), state.points.data(), state.points.data() + state.points.size());
  chain.log_density.insert(chain.log_density.end(), state.log_density.begin(), state.log_density.end());
  ++chain.steps;
  chain.acceptance = double(state.accepted) / double(state.proposed);
}

void make_step(SamplerState& state, const LogDensity& density, const SamplerOptions& options,
               RandomStream& random) {
  move_walkers(state, density, options, random);
  ++state.step;
  if (state.step <= options.burn_in)
    adapt(state, options, random);
  else if ((state.step - options.burn_in) % options.thinning == 0)
    keep_step(state);
}

/// Reports progress about once a second.
class Reporter {
public:
  Reporter(const ProgressReport& report, const SamplerOptions& options, const SamplerState& state)
      : report(report), options(options), first_step(state.step), accepted(state.accepted),
        proposed(state.proposed) {}

  /// False if the callback stops the run.
  bool update(const SamplerState& state, std::int64_t all_steps, bool now) {
    if (!report || (!now && seconds_since(last) < 1)) return true;
    if (state.proposed < proposed) accepted = proposed = 0; // burn-in has ended and reset the counters
    SamplerProgress p;
    p.fraction = double(state.step) / double(all_steps);
    p.acceptance =
        double(state.accepted - accepted) / double(std::max<std::int64_t>(1, state.proposed - proposed));
    p.seconds_left = seconds_since(begin) * double(all_steps - state.step) /
                     double(std::max<std::int64_t>(1, state.step - first_step));
    p.burning_in = state.step < options.burn_in;
    accepted = state.accepted;
    proposed = state.proposed;
    last = Clock::now();
    return report(p);
  }

private:
  const ProgressReport& report;
  const SamplerOptions& options;
  Clock::time_point begin = Clock::now(), last = begin;
  std::int64_t first_step, accepted, proposed;
};

} // namespace

Chain sample(const LogDensity& density, const Eigen::MatrixXd& start, const SamplerOptions& options,
             const Checkpoint& checkpoint, const ProgressReport& report) {
  check(options, start);
  const std::int64_t all_steps = options.burn_in + std::int64_t(options.steps) * options.thinning;
  std::optional<ChainFile> file;
  if (!checkpoint.file.empty()) file.emplace(checkpoint, options);
  RandomStream random(options.seed);
  SamplerState state;
  if (file && file->exists()) {
    state = file->read(int(start.rows()));
    random.restore(state.random);
  } else {
    state = begin(density, start, options, random);
  }
  state.chain.complete = false;
  Reporter reporter(report, options, state);
  auto written = Clock::now();
  const auto write = [&] {
    if (!file) return;
    state.random = random.state();
    file->write(state);
    written = Clock::now();
  };
  bool running = true;
  while (state.step < all_steps && running) {
    make_step(state, density, options, random);
    if (state.step < all_steps && seconds_since(written) >= checkpoint.interval) write();
    running = reporter.update(state, all_steps, state.step == all_steps);
  }
  state.chain.complete = state.step == all_steps;
  write();
  return std::move(state.chain);
}

} // namespace calibration
