// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/csv_write.hpp"
#include "tests/charts/cycles.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace charts {
namespace {

/// A cycle gives away energy that the defect does not explain where work less stored energy less defect stays below
/// minus this share of the gross work, however short the increments.
constexpr double tolerance = 1e-6;
constexpr int finest = 64; ///< times as many increments as asked for

/// Compressed and sheared, expanded and sheared back: the cycle whose defect is largest. Starts at 1 kPa, far inside of
/// the yield surface.
void print_elastic() {
  fmt::print("elastic cycles: shear to and fro at two mean stresses; energy per volume over the largest "
             "stored in shear\n");
  fmt::print("{:>9} {:>10} {:>10} {:>12} {:>10}   {:>12} {:>12}\n", "p2 / p1", "work", "defect",
             "unexplained", "G2/G1 - 1", "last of 200:", "dissipation");
  const auto m = material_of(properties(sands[0]));
  for (const double ratio : {1.01, 1.1, 2., 10.})
    for (const int sign : {1, -1}) {
      const double p1 = 1e3, e = 0.6, shear = 2e-6;
      const double y1 = simsand::pressure_of_mean_stress(m, p1).measure;
      const double y2 = simsand::pressure_of_mean_stress(m, p1 * ratio).measure;
      const double volume = (y2 - y1) / (m.given.K0 * simsand::void_ratio_factor(e));
      const auto compressed = simsand::add_mean(Tensor{}, volume / 3);
      Tensor sheared{}, both = compressed;
      sheared[3] = both[3] = shear;
      Point point{simsand::add_mean(Tensor{}, p1), e, 0.1, 0};
      const double K = simsand::bulk_modulus(m, e, simsand::pressure_of_mean_stress(m, p1));
      const double G1 = m.shear_ratio * K, scale = 2 * G1 * shear * shear; // q^2 / 6G of s12 = 2 G shear
      std::vector<Tensor> corners{Tensor{}, sheared, both, compressed};
      if (sign < 0) std::reverse(corners.begin() + 1, corners.end());
      const auto sum = lead_through(m, point, corners, 2000, 1);
      const double K2 = simsand::bulk_modulus(m, simsand::void_ratio_after(e, volume),
                                              simsand::pressure_of_mean_stress(m, p1 * ratio));
      lead_through(m, point, corners, 100, 198);
      const auto last = lead_through(m, point, corners, 2000, 1);
      fmt::print("{:9g} {:10.5f} {:10.5f} {:12.1e} {:10.5f}   {:12.5f} {:12.5f}\n", ratio, sum.work / scale,
                 (sum.defect + sum.stored) / scale, sum.unexplained() / scale, sign * (K2 / K - 1),
                 last.work / scale, last.dissipation / scale);
    }
}

struct Judged {
  double amplitude;
  CycleEnergy energy;
  double given,
      refined; ///< share of the gross work given away beyond the defect: as asked for, and with more increments
  bool violated() const { return energy.failed || refined > tolerance; }
};

double given_beyond_defect(const CycleEnergy& e) {
  return e.gross > 0 ? (e.defect - e.gain()) / e.gross : 0;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + long(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<Judged> judge(const CycleOptions& options, double amplitude) {
  std::vector<Judged> all(options.count);
#pragma omp parallel for schedule(dynamic, 16)
  for (int i = 0; i < options.count; ++i) {
    const auto cycle = random_cycle(i, amplitude);
    const auto m = material_of(properties(sands[cycle.sand]));
    const auto run = [&](int parts) {
      Point point = cycle.start;
      return lead_through(m, point, cycle.corners, parts, 1);
    };
    Judged j{amplitude, run(options.parts), 0, 0};
    j.given = j.refined = given_beyond_defect(j.energy);
    for (int more = 4; more <= finest && j.refined > tolerance; more *= 4)
      j.refined = given_beyond_defect(run(options.parts * more));
    all[i] = j;
  }
  return all;
}

int print_random(const std::vector<Judged>& all) {
  std::vector<double> unexplained, defect, gain, given, refined;
  int violations = 0, gifts = 0, plastic = 0;
  for (const auto& j : all) {
    violations += j.violated();
    if (!(j.energy.gross > 0)) continue;
    gifts += j.energy.gain() < 0;
    plastic += j.energy.plastic_strain > 0;
    unexplained.push_back(std::abs(j.energy.unexplained()) / j.energy.gross);
    defect.push_back(std::abs(j.energy.defect) / j.energy.gross);
    gain.push_back(-j.energy.gain() / j.energy.gross);
    given.push_back(j.given);
    refined.push_back(j.refined);
  }
  fmt::print("{:>9g} {:7} {:7} {:7} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:9}\n",
             all.front().amplitude, all.size(), plastic, gifts, std::max(quantile(gain, 1), 0.),
             quantile(defect, 0.5), quantile(defect, 1), quantile(unexplained, 0.5),
             std::max(quantile(given, 1), 0.), std::max(quantile(refined, 1), 0.), violations);
  return violations;
}

void add_rows(const std::vector<Judged>& all, drivers::CsvWriter& table) {
  for (const auto& j : all) {
    for (const double value : {j.amplitude, j.energy.work, j.energy.gross, j.energy.dissipation,
                               j.energy.stored, j.energy.defect, j.energy.plastic_strain, j.given, j.refined})
      table.cell(drivers::Rounded{value});
    table.end_row();
  }
}

} // namespace

bool chart_cycles(const CycleOptions& options) {
  print_elastic();
  fmt::print("\nrandom closed cycles, {} increments per side; energies over the gross work\n", options.parts);
  fmt::print("{:>9} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "amplitude", "cycles",
             "plastic", "W < dpsi", "by most", "delta 50%", "largest", "unexpl.", "beyond d.", "refined",
             "violated");
  drivers::CsvWriter table(
      "amplitude,work_Pa,gross_work_Pa,dissipation_Pa,stored_Pa,defect_Pa,plastic_strain,"
      "given_beyond_defect,given_beyond_defect_refined");
  int violations = 0;
  for (const double amplitude : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const auto all = judge(options, amplitude);
    violations += print_random(all);
    add_rows(all, table);
  }
  if (!options.output.empty()) table.write(options.output);
  return violations == 0;
}

} // namespace charts
