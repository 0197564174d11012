// SPDX-License-Identifier: BSD-3-Clause
// One `[[test]]` of a fit: reads its curves in the units and signs declared, turns them to those of the fit
// (lab_test.hpp), and refuses what cannot be: manual in README.md.
#pragma once
#include "calibration/lab_test.hpp"
#include "drivers/files/toml_table.hpp"
#include <optional>

namespace calibration {

/// Reads a test. `columns` is the table `[columns]` of the document, for tests without their own. Throws
/// std::runtime_error naming file, line and key or column.
LabTest read_test(const drivers::TomlTable& table, const std::optional<drivers::TomlTable>& columns);

/// Columns of a test as they are in the file, turned to SI and the signs of the fit.
struct RawCurves {
  std::vector<double> strain;
  std::array<std::optional<std::vector<double>>, measures.size()> given;
};

/// Throws std::runtime_error that begins with `where` if curves contradict each other, what is declared, or soil: stress
/// ratios that no friction reaches or that are next to nothing, void ratios that no sand has, strains that turn back.
void check_plausible(const RawCurves& raw, const Specimen& specimen, const std::vector<Curve>& compared,
                     const std::string& where);

} // namespace calibration
