// SPDX-License-Identifier: BSD-3-Clause
// Evaluations of the log posterior per second of processor time, on one thread: each simulates all tests of a fit.
// The parameters are those of the fit's material, each changed at random by up to 5 % of its range. Median over
// the turns. Usage: posterior_rate [FIT.toml], by default data/fits/ss_noise.toml.
#include "calibration/least_squares.hpp"
#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <omp.h>

namespace {

using namespace calibration;

constexpr int sets = 64, turns = 9;
constexpr double scatter = 0.05; ///< of the range of a parameter

/// Processor time of this thread, s.
double seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Sets of parameters near those of the material, as columns.
Eigen::MatrixXd near_material(const Fit& fit) {
  Eigen::MatrixXd points = spread_points(fit.unknowns, sets, 1);
  for (Eigen::Index d = 0; d < points.rows(); ++d) {
    const auto& p = fit.unknowns[std::size_t(d)];
    if (p.property < 0) continue; // an error of the model: anywhere within its bounds
    const double value =
        std::clamp(fit.material.material.properties[std::size_t(p.property)], p.lower, p.upper);
    const double middle = 0.5 * (p.lowest() + p.highest());
    for (double& u : points.row(d))
      u = std::clamp(p.coordinate(value) + 2 * scatter * (u - middle), p.lowest(), p.highest());
  }
  return points;
}

} // namespace

int main(int count, char** arguments) {
  omp_set_num_threads(1);
  const auto fit = read_fit(count > 1 ? arguments[1] : SIMSAND_SOURCE_DIR "/data/fits/ss_noise.toml");
  const Objective objective(fit);
  const auto points = near_material(fit);
  std::vector<double> rates;
  for (int turn = 0; turn < turns; ++turn) {
    const double start = seconds();
    objective.log_posterior(points);
    rates.push_back(sets / (seconds() - start));
  }
  std::sort(rates.begin(), rates.end());
  fmt::print("{:.0f} evaluations/s, {:.3g} ms each; {} tests\n", rates[turns / 2], 1e3 / rates[turns / 2],
             fit.tests.size());
}
