// SPDX-License-Identifier: BSD-3-Clause
// One `[[test]]` of a fit: reads its curves in the units and signs declared, converts them to those of the fit
// (lab_test.hpp), and refuses data that no test on sand can have given. Manual: README.md.
#pragma once
#include "calibration/lab_test.hpp"
#include "drivers/files/toml_table.hpp"
#include <optional>

namespace calibration {

/// Reads a test. `columns` is the table `[columns]` of the document, for tests without their own. Throws
/// std::runtime_error naming file, line and key or column.
LabTest read_test(const drivers::TomlTable& table, const std::optional<drivers::TomlTable>& columns);

/// Columns of a test file, converted to SI units and the signs of the fit.
struct RawCurves {
  std::vector<double> strain;
  std::array<std::optional<std::vector<double>>, measures.size()> given;
};

/// Throws std::runtime_error that begins with `where` if curves contradict each other or the declared values, or are
/// impossible for sand: stress ratios beyond any friction angle or near 0 throughout, void ratios outside of 0.1 to 1.9.
void check_plausible(const RawCurves& raw, const Specimen& specimen, const std::vector<Curve>& compared,
                     const std::string& where);

} // namespace calibration
