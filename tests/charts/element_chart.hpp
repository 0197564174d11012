// SPDX-License-Identifier: BSD-3-Clause
// `chart element`: error, cost and failures of the integrators on laboratory paths and on updates of a run.
#pragma once
#include "tests/charts/cases.hpp"
#include "tests/charts/methods.hpp"

namespace charts {

struct ElementOptions {
  std::string folder = "results/chart";
  std::string states; ///< table of updates sampled from a run; empty: laboratory paths alone
  std::vector<double> increments{1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  CaseChoice choice;
  int repetitions = 3; ///< of each measurement of cost, of which the least counts
  bool figures = true; ///< draw the tables: element.csv, and increments.csv where it lies beside it
};

/// How one method did on one group of cases. Errors are |stress - reference| over the largest of reference, first
/// stress and p_min, all as sqrt(a : a), after the last increment.
struct Row {
  std::string method, setting;
  double increment; ///< 0: as sampled
  std::string group, member;
  long cases, updates;
  double error_median, error_95, error_largest;
  long over_a_tenth;                       ///< cases that claim success with an error above 0.1
  long not_finite, not_converged, drifted; ///< cases that failed so at some update
  double nanoseconds;                      ///< processor time per update; NaN for parts of the cases
};

inline constexpr const char* element_header = "integrator,setting,strain_increment,group,member,cases,"
                                              "updates,error_median,error_95,error_largest,over_a_tenth,"
                                              "not_finite,not_converged,drifted,nanoseconds_per_update";

/// What the cases end at.
struct Target {
  Tensor stress;
  int updates; ///< until the end or until the stress is lost
  bool found;
};
std::vector<Target> targets_of(const std::vector<Case>& cases, const std::vector<Material>& materials);

/// All methods on these cases, whose materials are `props[sand]`, or the last of them for sand -1.
std::vector<Row> compare(const std::vector<Case>& cases, const std::vector<std::vector<double>>& props,
                         const std::vector<Method>& methods, int repetitions);

/// Writes element.csv, prints a table and draws. Throws std::runtime_error.
void chart_element(const ElementOptions& options);

} // namespace charts
